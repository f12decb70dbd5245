// Which runs a sweep has, which of them a part does, and which are done already.
#include "study/sweep_job.h"

#include <gtest/gtest.h>

#include "std.h"
#include "study/sweep_folders.h"

namespace carom {
namespace {

using testing::SweepPlace;

using Numbers = vector<size_t>;

const string masses = "grid: {balls.red.mass: [1, 2, 3]}\n";

/// The errors of a sweep that plan() refuses.
string refusal(const SweepPlace& place, const string& lines) {
  try {
    place.planned(lines);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SweepPlan, CountsEveryRunAsMissingInANewFolder) {
  const SweepPlace place;
  const SweepJob job = place.planned(masses);
  ASSERT_EQ(job.runs().size(), 3u);
  for (const PlannedRun& run : job.runs()) EXPECT_EQ(run.status, RunStatus::missing);
  EXPECT_EQ(job.of_part(), (Numbers{0, 1, 2}));
  EXPECT_EQ(job.left(), 3u);
}

TEST(SweepPlan, TellsScenesAndMotionsApartByDigest) {
  const SweepPlace place;
  const SweepJob job =
      place.planned("list: [{balls.red.mass: 1}, {balls.red.mass: 1.0}, {balls.red.color: '#ff0000'}]\n");
  const vector<PlannedRun>& runs = job.runs();
  EXPECT_EQ(runs[0].motion, runs[1].motion);
  EXPECT_EQ(runs[0].motion, runs[2].motion);
  EXPECT_NE(runs[0].scene, runs[2].scene);
}

TEST(SweepPlan, ReportsAnErrorOfManyRunsOnce) {
  const SweepPlace place;
  const string errors = refusal(place, "set: {balls.blue.mass: -1}\n" + masses);
  const size_t first = errors.find("mass");
  EXPECT_NE(errors.find("r0001"), string::npos) << errors;
  EXPECT_EQ(errors.find("r0002"), string::npos) << errors;
  EXPECT_NE(first, string::npos);
}

TEST(SweepPlan, LeavesInvalidRunsOutIfTheSweepSaysSo) {
  const SweepPlace place;
  const SweepJob job = place.planned("skip_invalid: true\ngrid: {balls.red.mass: [1, -1, 2]}\n");
  ASSERT_EQ(job.invalid().size(), 1u);
  EXPECT_EQ(job.invalid()[0].number, 1u);
  EXPECT_EQ(job.runs()[1].status, RunStatus::left_out);
  EXPECT_EQ(job.of_part(), (Numbers{0, 2}));
}

TEST(SweepPlan, RefusesASweepOfInvalidRunsAlone) {
  const SweepPlace place;
  EXPECT_NE(refusal(place, "skip_invalid: true\ngrid: {balls.red.mass: [-1, -2]}\n"), "");
}

TEST(Shards, HaveEveryRunOnceAndKeepMotionsTogether) {
  const SweepPlace place;
  const string lines = "grid: {balls.red.mass: [1, 2, 3, 4, 5], balls.red.color: ['#ff0000', '#00ff00']}\n";

  set<size_t> all;
  for (const size_t index : {1, 2, 3}) {
    const Numbers mine = place.planned(lines, {index, 3}).of_part();
    for (const size_t number : mine) EXPECT_TRUE(all.insert(number).second) << number;
    // Two neighbours differ in the colour alone.
    for (const size_t number : mine) EXPECT_TRUE(ranges::count(mine, number ^ 1) == 1) << number;
  }
  EXPECT_EQ(all.size(), 10u);
}

TEST(Shards, DoNotDependOnWhatIsDone) {
  const SweepPlace place;
  const Numbers before = place.planned(masses, {2, 2}).of_part();
  SweepJob first = place.planned(masses, {1, 2});
  EXPECT_TRUE(place.do_runs(first).empty());

  const SweepJob again = place.planned(masses, {2, 2});
  EXPECT_EQ(again.of_part(), before);
  EXPECT_EQ(again.left(), before.size());
}

TEST(Shards, BeyondTheMotionsAreEmpty) {
  const SweepPlace place;
  EXPECT_TRUE(place.planned(masses, {4, 4}).of_part().empty());
}

TEST(Resume, DoesOnlyWhatIsMissing) {
  const SweepPlace place;
  SweepJob job = place.planned(masses);
  EXPECT_TRUE(place.do_runs(job).empty());
  EXPECT_EQ(place.planned(masses).left(), 0u);

  std::filesystem::remove_all(place / "out/runs/r0002");
  const SweepJob again = place.planned(masses);
  EXPECT_EQ(again.left(), 1u);
  EXPECT_EQ(again.runs()[1].status, RunStatus::missing);
  EXPECT_EQ(again.runs()[2].status, RunStatus::done);
}

TEST(Resume, RunsAgainWhatMayHaveChangedInAnUnfinishedSweep) {
  const SweepPlace place;
  SweepJob job = place.planned(masses);
  EXPECT_TRUE(place.do_runs(job).empty());
  place.write("out/runs/r0001/energy.csv", "changed");
  const SweepJob again = place.planned(masses);
  EXPECT_EQ(again.runs()[0].content, FolderContent::incomplete);
  EXPECT_EQ(again.left(), 1u);
  EXPECT_FALSE(again.other_content());
}

TEST(Resume, DoesNotOverwriteAnotherScenesRun) {
  const SweepPlace place;
  place.run(testing::two_balls, "out/runs/r0002");
  const SweepJob job = place.planned(masses);
  EXPECT_EQ(job.other_content(), optional<size_t>(1));
}

TEST(SweepRuns, WithEqualScenesAreCopies) {
  const SweepPlace place;
  SweepJob job = place.planned("list: [{balls.red.mass: 2}, {balls.red.mass: 2.0}]\n");
  EXPECT_TRUE(place.do_runs(job).empty());
  EXPECT_EQ(place.read("out/runs/r0001/energy.csv"), place.read("out/runs/r0002/energy.csv"));
  EXPECT_EQ(place.read("out/runs/r0001/summary.csv"), place.read("out/runs/r0002/summary.csv"));
  EXPECT_EQ(place.planned("list: [{balls.red.mass: 2}, {balls.red.mass: 2.0}]\n").left(), 0u);
}

TEST(Seeds, BeginWithThatOfTheBaseUnlessTheSweepSetsOne) {
  const SweepPlace place;
  place.write("base.yaml", testing::quick_scene + "seed: 7\n");
  EXPECT_EQ(place.job("repeat: {seeds: 2}\n").sweep().run(1).values.back(), "8");
  EXPECT_EQ(place.job("repeat: {seeds: 2, first: 3}\n").sweep().run(1).values.back(), "4");
  EXPECT_EQ(place.job("set: {seed: 20}\nrepeat: {seeds: 2}\n").sweep().run(0).values.back(), "20");
}

TEST(IdlePaths, AreThoseThatChangeNeitherMotionNorMeasures) {
  const SweepPlace place;
  place.write("base.yaml", testing::quick_scene + "let: {unused: 1}\n");
  const SweepJob job = place.planned("grid: {balls.red.mass: [1, 2], let.unused: [1, 2]}\n");
  EXPECT_EQ(job.idle_paths(), (vector<string>{"let.unused"}));
}

TEST(IdlePaths, DoNotNameAppearance) {
  const SweepPlace place;
  EXPECT_TRUE(place.planned("grid: {balls.red.color: ['#ff0000', '#00ff00'], title: [a, b]}\n").idle_paths().empty());
}

TEST(MayReadFiles, IfTheBaseOrTheSweepNamesAMeshOrAStart) {
  const SweepPlace place;
  EXPECT_FALSE(may_read_files(place.sweep(masses), testing::quick_scene));
  EXPECT_TRUE(may_read_files(place.sweep(masses), testing::quick_scene + "start: {run: a}\n"));
  EXPECT_TRUE(may_read_files(place.sweep("list: [{balls.red.mesh: a.stl}]\n"), testing::quick_scene));
}

}  // namespace
}  // namespace carom
