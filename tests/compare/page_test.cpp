// The page of a comparison: well-formed, with its links, and whatever texts the runs have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "compare/comparison_testing.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "workbook/number_look.h"

namespace carom::testing {
namespace {

const string hostile = "<script>boom()</script> & \"it's\"";

/// Whether an XML parser accepts the page.
bool is_well_formed(const Place& place, const string& page) {
  const string command =
      "/usr/bin/python3 -c 'import sys, xml.etree.ElementTree; xml.etree.ElementTree.parse(sys.argv[1])' '" +
      place / page + "' 2> /dev/null";
  return std::system(command.c_str()) == 0;
}

/// The values of `href` and `src`.
vector<string> addresses(const string& page) {
  const std::regex address(" (href|src)=[\"']([^\"']*)[\"']");
  vector<string> found;
  for (std::sregex_iterator at(page.begin(), page.end(), address), end; at != end; ++at) found.push_back((*at)[2]);
  return found;
}

size_t count(const string& text, string_view part) {
  size_t found = 0;
  for (size_t at = 0; (at = text.find(part, at)) != string::npos; at += part.size()) ++found;
  return found;
}

/// Six runs of two balls by restitution and mass, and their comparison.
class PageOfSix : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place = new Place;
    runs = six_runs(*place, "runs/");
    place->write("runs/r2/sheet.png", "a picture");
    place->write("runs/r3/animation.mp4", "a film");
    place->write("runs/r4/film #1.gif", "a film");

    plan.title = "Six runs";
    plan.parameters = {{"restitution.default", ""}, {"balls.red.mass", "kg"}};
    plan.measures = {"energy_lost_J", "collisions", "balls.red.speed_m_per_s"};
    place->compare(plan, runs, "out");
    page = place->read("out/index.html");
  }
  static void TearDownTestSuite() {
    delete place;
    runs.clear();
  }

  static inline Place* place;
  static inline ComparisonPlan plan;
  static inline vector<ComparedRun> runs;
  static inline string page;
};

TEST_F(PageOfSix, IsWellFormedAndAsksForNothingFromElsewhere) {
  EXPECT_TRUE(is_well_formed(*place, "out/index.html"));
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"));
  EXPECT_EQ(page.find("http"), string::npos);
  EXPECT_EQ(page.find("@import"), string::npos);
  EXPECT_EQ(page.find("url("), string::npos);
}

TEST_F(PageOfSix, LinksOnlyWhatIsThere) {
  const vector<string> found = addresses(page);
  for (const string& address : found) {
    if (address.starts_with("#")) {
      EXPECT_EQ(count(page, "id=\"" + address.substr(1) + "\"") + count(page, "id='" + address.substr(1) + "'"), 1u)
          << address;
      continue;
    }
    string path = std::regex_replace(address, std::regex("%20"), " ");
    path = std::regex_replace(path, std::regex("%23"), "#");
    EXPECT_TRUE(std::filesystem::exists(*place / ("out/" + path))) << address;
  }

  for (const char* address : {"summary.csv", "comparison.xlsx", "../runs/r1/", "../runs/r2/sheet.png",
                              "../runs/r3/animation.mp4", "../runs/r4/film%20%231.gif", "#n6"})
    EXPECT_TRUE(contains(found, string(address))) << address;
  // Without a picture a film is shown itself, and is not loaded before that.
  EXPECT_NE(page.find("<video controls=\"\" preload=\"none\" muted=\"\" src=\"../runs/r3/animation.mp4\">"),
            string::npos);
  EXPECT_NE(page.find("<img loading=\"lazy\" alt=\"\" src=\"../runs/r2/sheet.png\"/>"), string::npos);
}

TEST_F(PageOfSix, HasARowForEachRunWithItsValues) {
  EXPECT_EQ(count(page, "<tr id=\"n"), 6u);
  // With e = 1 the red ball of 10 kg leaves at 2 m/s, and nothing is lost. The number of collisions is the same.
  EXPECT_NE(page.find("<td>1.00</td><td>10</td><td>0.00"), string::npos);
  EXPECT_NE(page.find("The same in all rows: collisions: 1."), string::npos);
  EXPECT_NE(page.find("<p>The same in all runs: collisions = 1.</p>"), string::npos);
}

TEST_F(PageOfSix, BeginsWithWhatWasVariedAndTheExtremes) {
  const size_t varied = page.find("<td class=\"t\">balls.red.mass</td><td>2</td><td>10 kg</td><td>20 kg</td>");
  const size_t highest = page.find("<th>energy lost (J)</th><td><b>");
  const size_t table = page.find("<table id=\"runs\">");
  ASSERT_NE(varied, string::npos);
  ASSERT_NE(highest, string::npos);
  EXPECT_LT(varied, highest);
  EXPECT_LT(highest, table);
  // At e = 0.5 the heavier ball loses most: (1 - e^2) (m M / (m + M)) v^2 / 2 = 0.75 * 20/3 * 16 / 2 = 40 J.
  EXPECT_NE(page.find("<th>energy lost (J)</th><td><b>40.0"), string::npos);
  // A heat map of three by two cells, each linked to its run.
  EXPECT_EQ(count(page, "<figure class=\"heat\">"), 2u);
  EXPECT_NE(page.find("<a href=\"#n2\" title=\"restitution.default = 0.5, mass = 20: 40\">"), string::npos);
}

TEST_F(PageOfSix, HasTheSameBytesEachTime) {
  place->compare(plan, runs, "again");
  EXPECT_EQ(place->read("again/index.html"), page);
}

TEST(ComparisonPage, EscapesEveryText) {
  const Place place;
  const string scene =
      std::regex_replace(two_balls, std::regex("title: Two balls"), "title: '<img src=x> \xE2\x80\xAE'");
  vector<ComparedRun> runs;
  for (const char* e : {"0.5", "1"}) {
    const string id = hostile.substr(0, 7) + e;
    place.run(scene, id, {string("restitution.default=") + e});
    runs.push_back({id, place / id, {e, hostile + e}});
  }
  runs.push_back({"'failed'", place / "no", {"1", ""}, true});
  place.write("no/error.txt", hostile);

  ComparisonPlan plan;
  plan.title = hostile;
  plan.parameters = {{"restitution.default", ""}, {"<i>", "<b>"}};
  plan.measures = {"energy_lost_J", "= if(energy_lost_J < 3, 1, 2)"};
  place.compare(plan, runs, "out");
  const string page = place.read("out/index.html");

  EXPECT_TRUE(is_well_formed(place, "out/index.html"));
  EXPECT_EQ(count(page, "<script>"), 1u);
  EXPECT_EQ(page.find("<img src=x>"), string::npos);
  EXPECT_EQ(page.find("<i>"), string::npos);
  EXPECT_EQ(page.find("\xE2\x80\xAE"), string::npos);
  EXPECT_NE(page.find("<h1>&lt;script&gt;boom()&lt;/script&gt; &amp; &quot;it&#39;s&quot;</h1>"), string::npos);
  EXPECT_NE(page.find("href=\"../%3Cscript0.5/\""), string::npos);
  EXPECT_NE(page.find("<tr id=\"n3\" class=\"failed\">"), string::npos);
  EXPECT_NE(page.find("<span class=\"flag failed\">1 failed</span>"), string::npos);
}

TEST(ComparisonPage, OfManyRunsIsSmallAndHasTheFirstFiveThousand) {
  const Place place;
  const array<string, 4> masses = {"5", "10", "20", "40"};
  for (const string& mass : masses) place.run(two_balls, mass, {"balls.red.mass=" + mass});
  ComparisonPlan plan;
  plan.title = "Many";
  plan.parameters = {{"balls.red.mass", "kg"}, {"balls.blue.mass", "kg"}};
  plan.measures = {"energy_lost_J", "collisions", "max_speed_m_per_s"};

  const auto compared = [&](size_t runs, const string& out) {
    vector<ComparedRun> all;
    for (size_t i = 0; i < runs; ++i)
      all.push_back({fmt::format("r{:04}", i + 1),
                     place / masses[i % masses.size()],
                     {to_string(1 + i % 40), to_string(1 + i / 40)}});
    place.compare(plan, all, out);
    return place.read(out + "/index.html");
  };

  // Two heat maps of 25 x 40 cells, their charts, and a table of 1,000 rows. Measured: 0.43 MB.
  const string thousand = compared(1000, "thousand");
  EXPECT_EQ(count(thousand, "<figure class=\"heat\">"), 2u);
  EXPECT_LT(thousand.size(), 500'000u);

  const string page = compared(5001, "many");
  EXPECT_EQ(count(page, "<tr id=\"n"), 5000u);
  EXPECT_NE(page.find("The first 5000 of 5001 runs; summary.csv has all."), string::npos);
  EXPECT_LT(page.size(), 3'000'000u);
}

TEST(ComparisonPage, WithoutGnuplotSaysSo) {
  const Place place;
  vector<ComparedRun> runs;
  for (const char* e : {"0.5", "0.75", "1"}) {
    place.run(two_balls, e, {string("restitution.default=") + e});
    runs.push_back({e, place / e, {e}});
  }
  ComparisonPlan plan;
  plan.parameters = {{"restitution.default", ""}};
  plan.measures = {"energy_lost_J"};

  const string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  place.compare(plan, runs, "without");
  setenv("PATH", path.c_str(), 1);
  place.compare(plan, runs, "with");

  const string without = place.read("without/index.html"), with = place.read("with/index.html");
  EXPECT_NE(without.find("<p class=\"doubtful\">1 chart is left out: the plots need gnuplot, which is not on the PATH: "
                         "install it (on Debian: apt install gnuplot-nox). Then compare the runs again.</p>"),
            string::npos);
  EXPECT_TRUE(is_well_formed(place, "without/index.html"));
  EXPECT_EQ(count(without, "class=\"chart\""), 0u);
  EXPECT_EQ(count(with, "class=\"chart\""), 1u);
  EXPECT_EQ(count(with, "id='gpPt6'"), 1u);
}

TEST(NumberLookText, HasTheDigitsOfTheColumn) {
  NumberLook look;
  for (const double number : {3.25, 0.5, -1e-15}) look.add(number);
  EXPECT_EQ(look.text(3.25), "3.2500");
  EXPECT_EQ(look.text(0.5), "0.5000");
  EXPECT_EQ(look.text(-1e-15), "0.0000");
  EXPECT_EQ(look.text(std::nan("")), "");
}

}  // namespace
}  // namespace carom::testing
