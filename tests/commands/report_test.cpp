// The page of a run, by the real program.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

bool is_well_formed(const Workplace& here, const string& page) {
  return here.shell(
                 "/usr/bin/python3 -c 'import sys, xml.etree.ElementTree; xml.etree.ElementTree.parse(sys.argv[1])' " +
                 page)
             .code == 0;
}

TEST(Report, HasTheNumbersTheFilmTheChartsAndLinksToAllFiles) {
  const Workplace here;
  here.write("balls.yaml", two_balls("measures: {far: max(balls.red.x_m)}\n"
                                     "output: {collisions: true, frames: {fps: 4, size: [32, 18]}, "
                                     "video: {fps: 4, size: [32, 18], file: hit.gif}, report: true}\n"));
  const Finished run = here.carom({"run", "balls.yaml", "-o", "run"});
  ASSERT_EQ(run.code, 0) << run.err;
  const string page = here.read("run/index.html");
  EXPECT_TRUE(is_well_formed(here, "run/index.html"));

  set<string> links;
  const std::regex address(" (href|src)=\"([^#\"][^\"]*)\"");
  for (std::sregex_iterator at(page.begin(), page.end(), address), end; at != end; ++at) links.insert((*at)[2]);
  for (const string& link : links) EXPECT_TRUE(here.has("run/" + link)) << link;
  for (const char* file :
       {"summary.csv", "collisions.csv", "scene.yaml", "manifest.json", "hit.gif", "frames/frame_00000.png"})
    EXPECT_TRUE(links.contains(file)) << file;

  EXPECT_NE(page.find("<img class=\"film\" src=\"hit.gif\" alt=\"film\"/>"), string::npos);
  EXPECT_NE(page.find("<td class=\"t\">far</td><td><b>"), string::npos);
  EXPECT_NE(page.find("<td class=\"t\">collisions</td><td>1</td>"), string::npos);
  EXPECT_NE(page.find("<td class=\"k\">body-body</td><td class=\"k\">red</td><td class=\"k\">blue</td>"), string::npos);
  EXPECT_NE(page.find("<figcaption>Energy of all bodies</figcaption>"), string::npos);
  EXPECT_EQ(page.find("<script"), string::npos);
  // The manifest knows it, and a run of the same scene has the same page.
  EXPECT_NE(here.read("run/manifest.json").find("\"index.html\""), string::npos);
  EXPECT_NE(here.carom({"run", "balls.yaml", "-o", "run"}).out.find("up to date"), string::npos);
  here.carom({"run", "balls.yaml", "-o", "again", "-q"});
  EXPECT_EQ(here.read("again/index.html"), page);
}

TEST(Report, EscapesTheTextsOfTheScene) {
  const Workplace here;
  here.write("balls.yaml", std::regex_replace(two_balls("output: {report: true}\n"), std::regex("Two balls"),
                                              "'<script>boom()</script> & more'"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run", "-q"}).code, 0);
  const string page = here.read("run/index.html");
  EXPECT_TRUE(is_well_formed(here, "run/index.html"));
  EXPECT_EQ(page.find("<script"), string::npos);
  EXPECT_NE(page.find("<h1>&lt;script&gt;boom()&lt;/script&gt; &amp; more</h1>"), string::npos);
}

TEST(Report, IsWrittenWithPlotsAndOfARunThatEndsEarly) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {report: true}\n"));
  const Finished early = here.carom(
      {"run", "balls.yaml", "--only", "report,plots", "--set", "simulate.stop=[{collisions: 1}]", "-o", "early"});
  ASSERT_EQ(early.code, 0) << early.err;
  EXPECT_NE(here.read("early/index.html").find("ended by collisions"), string::npos);
  EXPECT_TRUE(here.has("early/plots/energy.svg"));
  // The charts are the same with the tables that they show and without.
  here.carom({"run", "balls.yaml", "--only", "report", "-o", "alone", "-q"});
  here.carom({"run", "balls.yaml", "--only", "report,plots", "-o", "both", "-q"});
  const auto charts = [&](const string& folder) {
    const string page = here.read(folder + "/index.html");
    return page.substr(page.find("<h2>Charts"), page.find("<h2>Numbers") - page.find("<h2>Charts"));
  };
  EXPECT_EQ(charts("alone"), charts("both"));
}

TEST(Report, WithoutGnuplotIsRefusedBeforeAnythingIsWritten) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {report: true}\n"));
  const Finished run = here.shell("PATH=/nowhere \"$CAROM\" run balls.yaml -o run");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("balls.yaml: error: the plots need gnuplot, which is not on the PATH\n"), string::npos)
      << run.err;
  EXPECT_FALSE(here.has("run"));
}

TEST(Report, StaysAsItIsWhenPicturesAreDrawnAgain) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {frames: {fps: 4, size: [32, 18]}, flights: true, report: true}\n"));
  ASSERT_EQ(here.carom({"run", "balls.yaml", "-o", "run", "-q"}).code, 0);
  const string page = here.read("run/index.html");
  const Finished same = here.carom({"render", "run", "--set", "background=navy"});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(here.read("run/index.html"), page);
  const Finished other = here.carom({"render", "run", "--only", "sheet"});
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.err.substr(0, other.err.find("\ncarom")),
            "run: the pictures have other names or another title than in index.html, which render leaves as it is\n"
            "  render to another folder with -o");
}

}  // namespace
}  // namespace carom::testing
