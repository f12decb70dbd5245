// What a sweep's folder holds, what stands there besides its runs, and the plan of its comparison.
#include "study/sweep_folder.h"

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "study/sweep_folders.h"

namespace carom {
namespace {

using testing::SweepPlace;

const string two_masses = "grid: {balls.red.mass: [1, 2]}\n";

SweepContent content(const SweepPlace& place, const string& lines) {
  return inspect_sweep_folder(place / "out", place.sweep(lines), place.read("base.yaml"));
}

/// Does all runs of a sweep, and finishes its folder.
void finish(const SweepPlace& place, const string& lines) {
  // While the runs are done, the folder is locked by another object.
  SweepJob job = place.planned(lines);
  EXPECT_TRUE(place.do_runs(job).empty());
  SweepFolder folder(place / "out", SweepFolder::Use::exclusive, job.sweep(), job.base_text(),
                     skipped_text(job.sweep(), job.base_text(), job.invalid()), [] {});
  vector<RunStatus> statuses;
  for (const PlannedRun& run : job.runs()) statuses.push_back(run.status);
  folder.finish(job.sweep(), statuses, {});
}

TEST(SweepContent, IsNothingBeforeAnyRun) {
  const SweepPlace place;
  EXPECT_EQ(content(place, two_masses), SweepContent::nothing);
  std::filesystem::create_directories(place / "out");
  EXPECT_EQ(content(place, two_masses), SweepContent::nothing);
}

TEST(SweepContent, IsRunsOfThisSweepUntilTheFolderIsFinished) {
  const SweepPlace place;
  SweepJob job = place.planned(two_masses);
  place.do_runs(job);
  EXPECT_EQ(content(place, two_masses), SweepContent::same_runs);
  EXPECT_FALSE(is_ended_sweep(place / "out"));

  finish(place, two_masses);
  EXPECT_EQ(content(place, two_masses), SweepContent::this_sweep);
  EXPECT_TRUE(is_ended_sweep(place / "out"));
}

TEST(SweepContent, WithAnotherComparisonHasTheSameRuns) {
  const SweepPlace place;
  finish(place, two_masses);
  EXPECT_EQ(content(place, two_masses + "compare: {measures: [energy_lost_J]}\n"), SweepContent::same_runs);
  EXPECT_EQ(content(place, "title: Another\n" + two_masses), SweepContent::same_runs);
}

TEST(SweepContent, OfOtherValuesOrAnotherBaseIsOther) {
  const SweepPlace place;
  finish(place, two_masses);
  EXPECT_EQ(content(place, "grid: {balls.red.mass: [1, 3]}\n"), SweepContent::other);
  place.write("base.yaml", testing::quick_scene + "title: Edited\n");
  EXPECT_EQ(content(place, two_masses), SweepContent::other);
}

TEST(SweepContent, OfAFolderThatNoSweepWroteIsOther) {
  const SweepPlace place;
  place.write("out/notes.txt", "mine");
  EXPECT_EQ(content(place, two_masses), SweepContent::other);
}

TEST(SweepContent, WithAChangedTableIsIncomplete) {
  const SweepPlace place;
  finish(place, two_masses);
  place.write("out/summary.csv", "changed");
  EXPECT_EQ(content(place, two_masses), SweepContent::same_runs);
}

TEST(SweepFolder, RemovesTheRunsOfAnotherSweep) {
  const SweepPlace place;
  finish(place, two_masses);
  const Sweep other = place.sweep("grid: {balls.red.mass: [5]}\n");
  const SweepFolder folder(place / "out", SweepFolder::Use::exclusive, other, place.read("base.yaml"), "", [] {});
  EXPECT_FALSE(std::filesystem::exists(place / "out/runs/r0001"));
  EXPECT_EQ(place.read("out/sweep.yaml"), other.resolved(stored_base));
}

TEST(SweepFolder, KeepsTheRunsOfTheSameSweep) {
  const SweepPlace place;
  finish(place, two_masses);
  const Sweep sweep = place.sweep("title: Another\n" + two_masses);
  const SweepFolder folder(place / "out", SweepFolder::Use::part, sweep, place.read("base.yaml"), "", [] {});
  EXPECT_TRUE(std::filesystem::exists(place / "out/runs/r0002/summary.csv"));
}

TEST(SweepFolder, IsSharedOnlyByParts) {
  const SweepPlace place;
  const Sweep sweep = place.sweep(two_masses);
  const auto use = [&](SweepFolder::Use how) {
    return SweepFolder(place / "out", how, sweep, place.read("base.yaml"), "", [] {});
  };
  const SweepFolder one = use(SweepFolder::Use::part);
  EXPECT_NO_THROW(use(SweepFolder::Use::part));
  EXPECT_THROW(use(SweepFolder::Use::exclusive), ExportError);
}

TEST(Skipped, RunsAreReadAsTheyWereWritten) {
  const SweepPlace place;
  const Sweep sweep = place.sweep(two_masses);
  const string text = skipped_text(sweep, "", {{1, "", "no mass, \"red\""}});
  EXPECT_EQ(text, "run,error\nr0002,\"no mass, \"\"red\"\"\"\n");

  place.write("out/skipped.csv", text);
  const auto skips = stored_skips(place / "out");
  ASSERT_EQ(skips.size(), 1u);
  EXPECT_EQ(skips[0].first, "r0002");
  EXPECT_EQ(skips[0].second, "no mass, \"red\"");
}

TEST(Skipped, NoRunsHaveNoFile) {
  const SweepPlace place;
  EXPECT_EQ(skipped_text(place.sweep(two_masses), "", {}), "");
  EXPECT_TRUE(stored_skips(place / "out").empty());
  EXPECT_TRUE(stored_failures(place / "out").empty());
}

TEST(Skipped, RunsHaveNoRowInTheSummary) {
  const SweepPlace place;
  finish(place, "skip_invalid: true\ngrid: {balls.red.mass: [1, -1, 2]}\n");
  const auto rows = testing::rows_of(place.read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1][0], "r0001");
  EXPECT_EQ(rows[2][0], "r0003");
}

TEST(ComparedRun, TakesAValueThatItsBlockLacksFromItsScene) {
  const SweepPlace place;
  const string lines = "runs: [{grid: {balls.red.mass: [5]}}, {grid: {balls.blue.mass: [6]}}]\n";
  finish(place, lines);
  const Sweep sweep = place.sweep(lines);
  EXPECT_EQ(compared_run(sweep, 0, place / "out/runs/r0001").values, (vector<string>{"5", "1"}));
  EXPECT_EQ(compared_run(sweep, 1, place / "out/runs/r0002").values, (vector<string>{"1", "6"}));
}

TEST(ComparedRun, WithoutAFolderHasItsOwnValuesAlone) {
  const SweepPlace place;
  const Sweep sweep = place.sweep("list: [{balls.red.mass: 5}, {balls.blue.mass: 6}]\n");
  EXPECT_EQ(compared_run(sweep, 0, place / "nowhere").values, (vector<string>{"5", ""}));
}

TEST(ComparisonPlan, HasAParameterForEachPathWithItsUnit) {
  const SweepPlace place;
  const Sweep sweep = place.sweep(
      "grid: {balls.red.mass: [1, 2]}\nrepeat: {seeds: 2}\n"
      "compare: {measures: [energy_lost_J], charts: [{x: balls.red.mass, y: energy_lost_J}], collisions: true}\n");
  const ComparisonPlan plan = comparison_plan(sweep, testing::quick_scene);
  ASSERT_EQ(plan.parameters.size(), 2u);
  EXPECT_EQ(plan.parameters[0].unit, "kg");
  EXPECT_EQ(plan.seed, optional<size_t>(1));
  EXPECT_EQ(plan.measures, (vector<string>{"energy_lost_J"}));
  EXPECT_EQ(plan.charts.size(), 1u);
  EXPECT_TRUE(plan.collisions);
}

}  // namespace
}  // namespace carom
