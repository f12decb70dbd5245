// carom plot, by the real program: charts of a finished run, equal to those that a run draws itself.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

using Files = map<string, string>;
using Words = vector<string>;

Files charts_in(const Workplace& here, const string& folder) {
  return here.files(folder + "/plots");
}

/// carom run of a scene of scenes/ with these outputs.
void run_ours(const Workplace& here, const string& scene, const string& only, const string& to) {
  const Finished run = here.carom({"run", SCENES_DIR "/" + scene + ".yaml", "--only", only, "-o", to, "-q"});
  ASSERT_EQ(run.code, 0) << run.err;
}

// Bodies that rest, many bodies, and bodies that merge.
class Plotted : public ::testing::TestWithParam<const char*> {};

TEST_P(Plotted, FromTablesIsWhatTheRunItselfDraws) {
  const Workplace here;
  run_ours(here, GetParam(), "trajectory,energy,collisions", "tables");
  run_ours(here, GetParam(), "trajectory,energy,collisions,plots", "run");
  const Finished plot = here.carom({"plot", "tables", "-q"});
  ASSERT_EQ(plot.code, 0) << plot.err;
  EXPECT_EQ(without_manifest(here.files("tables")), without_manifest(here.files("run")));
  EXPECT_EQ(here.files("tables/plots").size(), 8u);
}

TEST_P(Plotted, FromPathsIsWhatTheRunItselfDraws) {
  const Workplace here;
  run_ours(here, GetParam(), "flights,collisions", "paths");
  run_ours(here, GetParam(), "plots", "run");
  ASSERT_EQ(here.carom({"plot", "paths", "-q"}).code, 0);
  EXPECT_EQ(charts_in(here, "paths"), charts_in(here, "run"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Plotted, ::testing::Values("bouncing_ball", "gas_in_a_room", "clay"),
                         [](const auto& scene) { return string(scene.param); });

TEST(PlotRuns, IntoAnotherFolderIsTheRunOfThePlotsAlone) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "run"});
  ASSERT_EQ(here.carom({"plot", "run", "-o", "charts"}).code, 0);
  EXPECT_FALSE(here.has("run/plots"));
  here.carom({"run", "run/scene.yaml", "--only", "plots", "-o", "fresh"});
  EXPECT_EQ(without_manifest(here.files("charts")), without_manifest(here.files("fresh")));
  for (const Words& again : {Words{"plot", "run", "-o", "charts"},
                             {"plot", "charts"},
                             {"run", "run/scene.yaml", "--only", "plots", "-o", "charts"}})
    EXPECT_NE(here.carom(again).out.find("up to date"), string::npos) << again[0];
}

TEST(PlotRuns, OfTablesThatTheSceneDoesNotListHasASceneThatListsThem) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {collisions: true}\n"));
  here.carom({"run", "balls.yaml", "--only", "trajectory,energy,collisions", "-o", "run"});
  ASSERT_EQ(here.carom({"plot", "run", "-o", "charts"}).code, 0);
  here.carom({"run", "charts/scene.yaml", "--only", "plots", "-o", "fresh"});
  EXPECT_EQ(without_manifest(here.files("charts")), without_manifest(here.files("fresh")));
}

TEST(PlotRuns, KeepsTheOtherFilesAndLeavesTheRunUpToDate) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files before = here.files("run");
  ASSERT_EQ(here.carom({"plot", "run"}).code, 0);
  const Files after = here.files("run");
  for (const auto& [name, bytes] : before) EXPECT_TRUE(name == "manifest.json" || after.at(name) == bytes) << name;
  EXPECT_EQ(after.size(), before.size() + 8);
  EXPECT_NE(here.carom({"run", "balls.yaml", "-o", "run"}).out.find("up to date"), string::npos);
  EXPECT_NE(here.carom({"plot", "run"}).out.find("up to date"), string::npos);

  const auto manifest = nlohmann::json::parse(here.read("run/manifest.json"));
  EXPECT_EQ(manifest["outputs"]["plots"], true);
  EXPECT_EQ(manifest["files"].size(), after.size() - 1);
  EXPECT_TRUE(manifest["wall_times_s"].is_object());
}

TEST(PlotRuns, DrawsAgainWhatIsMissingOrForced) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "--set", "output.plots=true", "-o", "run"});
  const Files whole = here.files("run");
  here.write("run/plots/energy.svg", "something else");

  const Finished refused = here.carom({"plot", "run"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("holds a run of this scene with a changed file, plots/energy.svg"), string::npos)
      << refused.err;

  // What is missing is drawn, and by force all.
  here.shell("rm run/plots/energy.svg");
  EXPECT_NE(here.carom({"plot", "run"}).out.find("wrote"), string::npos);
  EXPECT_EQ(without_manifest(here.files("run")), without_manifest(whole));
  EXPECT_NE(here.carom({"plot", "run", "--force"}).out.find("wrote"), string::npos);
  EXPECT_EQ(without_manifest(here.files("run")), without_manifest(whole));

  // Nothing is drawn from a table that has changed.
  here.write("run/energy.csv", "time_s\n");
  const Finished changed = here.carom({"plot", "run", "--force"});
  EXPECT_EQ(changed.code, 2);
  EXPECT_EQ(changed.err.substr(0, changed.err.find('\n')), "run: energy.csv is missing or has changed");
}

TEST(PlotRuns, NamesTheKeyOfAChartThatTheRunHasNoDataFor) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "--only", "energy", "-o", "run"});
  const Finished plot = here.carom({"plot", "run"});
  EXPECT_EQ(plot.code, 0);
  EXPECT_EQ(plot.out,
            "run: Two balls\n"
            "  left out    heights: the run has no trajectory.csv, which the key output.trajectory gives\n"
            "  left out    speeds: the run has no trajectory.csv, which the key output.trajectory gives\n"
            "  left out    collisions: the run has no collisions.csv, which the key output.collisions gives\n"
            "  wrote       run/plots: energy, each as SVG and PNG\n");
  EXPECT_EQ(charts_in(here, "run").size(), 2u);
  EXPECT_NE(here.carom({"plot", "run"}).out.find("up to date"), string::npos);

  EXPECT_NE(here.carom({"run", "balls.yaml", "--only", "energy", "-o", "run"}).out.find("up to date"), string::npos);
  // A run has all data, so its charts are not up to date.
  EXPECT_EQ(here.carom({"run", "balls.yaml", "--only", "energy,plots", "-o", "run", "-q"}).code, 0);
  EXPECT_EQ(charts_in(here, "run").size(), 8u);
}

TEST(PlotRuns, RefusesARunWithoutAnyData) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "--only", "contacts", "-o", "run"});
  const Finished plot = here.carom({"plot", "run"});
  EXPECT_EQ(plot.code, 2);
  EXPECT_EQ(plot.err,
            "run: it has neither tables nor flights to plot\n"
            "  carom run run/scene.yaml --only plots -o OTHER simulates it again and draws the charts\n"
            "carom: 1 error; nothing was run\n");
  EXPECT_EQ(here.carom({"plot", "nothing"}).code, 2);
}

TEST(PlotRuns, WithoutGnuplotNamesTheRemedy) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Finished plot = here.shell("PATH=/nowhere; exec \"$CAROM\" plot run");
  EXPECT_EQ(plot.code, 1);
  EXPECT_EQ(plot.err,
            "carom: the plots need gnuplot, which is not on the PATH\n"
            "  install it (on Debian: apt install gnuplot-nox)\n");
}

TEST(PlotRuns, OfSeveralRunsIsTheSameForAnyNumberOfJobs) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  for (const char* name : {"a", "b"}) here.carom({"run", "balls.yaml", "--set", string("title=") + name, "-o", name});
  ASSERT_EQ(here.carom({"plot", "a", "b", "-o", "one"}).code, 0);
  ASSERT_EQ(here.carom({"plot", "a", "b", "-o", "two", "-j", "2"}).code, 0);
  EXPECT_EQ(here.files("one"), here.files("two"));
  EXPECT_EQ(charts_in(here, "one/b").size(), 8u);
}

TEST(PlotRuns, OfALongTableIsThatOfItsWideForm) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.carom({"run", "balls.yaml", "-o", "long"});
  here.carom({"run", "balls.yaml", "-o", "wide", "--set", "output.trajectory.layout=wide"});
  ASSERT_EQ(here.carom({"plot", "long", "wide", "-q"}).code, 0);
  EXPECT_EQ(charts_in(here, "long"), charts_in(here, "wide"));
}

TEST(Render, LeavesChartsAsTheyAreAndRefusesAnotherTitleForThem) {
  const Workplace here;
  here.write("balls.yaml", two_balls("output: {flights: true, plots: true}\n"));
  here.carom({"run", "balls.yaml", "-o", "run"});
  const Files charts = charts_in(here, "run");
  ASSERT_EQ(here.carom({"render", "run", "--only", "xyz"}).code, 0);
  EXPECT_EQ(charts_in(here, "run"), charts);
  const Finished titled = here.carom({"render", "run", "--only", "xyz", "--set", "title=Other"});
  EXPECT_EQ(titled.code, 2);
  EXPECT_EQ(titled.err.substr(0, titled.err.find('\n')),
            "run: --set changes the title, which the charts in plots/ show and render leaves as they are");
}

TEST(Sweep, DrawsTheChartsOfEveryRun) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  ASSERT_EQ(
      here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mass=5,10", "--only", "plots", "-o", "sweep", "-q"}).code,
      0);
  for (const char* run : {"sweep/runs/r0001", "sweep/runs/r0002"}) EXPECT_EQ(charts_in(here, run).size(), 8u) << run;
}

}  // namespace
}  // namespace carom::testing
