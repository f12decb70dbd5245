// Sweep files and their runs.
#include "scene/sweep.h"

#include "scene/scenes_in_text.h"

namespace carom {
namespace {

const std::string head = "sweep: 1\nbase: base.yaml\n";

Sweep sweep_of(const std::string& text) {
  write_file("", "base.yaml");
  const std::string path = write_file(text, "falls.yaml");
  Sweep sweep = load_sweep(path);
  std::filesystem::remove_all(test_folder());
  return sweep;
}

/// The values of every run: "a b; a b".
std::string values_of(const Sweep& sweep) {
  std::string out;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    std::string line;
    for (const auto& value : sweep.run(i).values) line += (line.empty() ? "" : " ") + value.value_or("-");
    out += (out.empty() ? "" : "; ") + line;
  }
  return out;
}

std::string sweep_errors(const std::string& text) {
  const std::string folder = test_folder() + "/";
  try {
    sweep_of(text);
    return "";
  } catch (const SceneError& error) {
    std::string out = error.what();
    for (std::size_t i = out.find(folder); i != std::string::npos; i = out.find(folder, i)) out.erase(i, folder.size());
    return out;
  }
}

TEST(SweepFile, GridIsEveryCombinationTheLastPathFastest) {
  const Sweep sweep = sweep_of(head + "grid:\n  a.x: {from: 0.5, to: 0.7, count: 3}\n  b: [1, 2]\n");
  EXPECT_EQ(sweep.paths, (std::vector<std::string>{"a.x", "b"}));
  EXPECT_EQ(values_of(sweep), "0.5 1; 0.5 2; 0.6 1; 0.6 2; 0.7 1; 0.7 2");
  EXPECT_EQ(sweep.run(5).id, "r0006");
  ASSERT_EQ(sweep.run(5).settings.size(), 2u);
  EXPECT_EQ(sweep.run(5).settings[0].text, "a.x=0.7");
  EXPECT_EQ(sweep.run(5).settings[1].text, "b=2");
}

TEST(SweepFile, ZipGoesInStepAndListAsGiven) {
  EXPECT_EQ(values_of(sweep_of(head + "zip: {a: [1, 2, 3], b: {from: 3, to: 1, step: -1}}\n")), "1 3; 2 2; 3 1");
  EXPECT_EQ(values_of(sweep_of(head + "list: [{a: 1}, {a: 2, b: [0, 1, 0]}, {b: exact}]\n")),
            "1 -; 2 [0, 1, 0]; - exact");
}

TEST(SweepFile, GridZipAndListOfOneBlockMultiply) {
  EXPECT_EQ(values_of(sweep_of(head + "grid: {a: [1, 2]}\nzip: {b: [3, 4], c: [5, 6]}\nlist: [{d: 7}]\n")),
            "1 3 5 7; 1 4 6 7; 2 3 5 7; 2 4 6 7");
}

TEST(SweepFile, BlocksFollowOneAnother) {
  EXPECT_EQ(values_of(sweep_of(head + "runs:\n  - grid: {a: [1, 2]}\n  - list: [{b: 3}]\n  - {}\n")),
            "1 -; 2 -; - 3; - -");
}

TEST(SweepFile, SkipLeavesOutWhatHasAllValuesOfAnEntry) {
  const std::string grid = "grid: {a: [1, 2, 3], b: [0.50, 0.6]}\n";
  EXPECT_EQ(values_of(sweep_of(head + grid + "skip: [{a: 2, b: 0.5}]\n")), "1 0.50; 1 0.6; 2 0.6; 3 0.50; 3 0.6");
  EXPECT_EQ(values_of(sweep_of(head + grid + "skip: [{a: [1, 3]}, {b: 0.6}]\n")), "2 0.50");
}

TEST(SweepFile, RepeatsTakeOneSeedAfterTheOther) {
  const Sweep sweep = sweep_of(head + "grid: {a: [1, 2]}\nrepeat: {seeds: 3, first: 10}\n");
  EXPECT_EQ(sweep.paths.back(), "seed");
  EXPECT_EQ(values_of(sweep), "1 10; 1 11; 1 12; 2 10; 2 11; 2 12");
  EXPECT_EQ(sweep.run(4).settings.back().text, "seed=11");
}

TEST(SweepFile, CommonSettingsComeBeforeARunsOwn) {
  const SweepRun run = sweep_of(head + "set: {a: 1, c: crimson}\ngrid: {a: [2]}\n").run(0);
  ASSERT_EQ(run.settings.size(), 3u);
  EXPECT_EQ(run.settings[0].text, "a=1");
  EXPECT_EQ(run.settings[1].text, "c=crimson");
  EXPECT_EQ(run.settings[2].text, "a=2");
}

TEST(SweepFile, ResolvedTextMeansTheSameAndResolvesToItself) {
  const std::string text = head +
                           "title: 'He said \"go\"'\nset: {x: '#ff0000'}\n"
                           "runs:\n  - grid: {a: {from: 0, to: 1, count: 3}, b: [[0, 1, 0], exact]}\n"
                           "    zip: {c: [1, 2], d: [3, 4]}\n    list: [{e: 1}, {f: \"2\"}]\n"
                           "    skip: [{a: 0.5, c: [1, 2]}]\n  - {}\n"
                           "repeat: {seeds: 2, first: 7}\nonly: [energy]\n"
                           "compare: {measures: [collisions], charts: [{x: a, y: collisions, by: b}]}\n";
  const Sweep sweep = sweep_of(text);
  const std::string resolved = sweep.resolved("base.yaml");
  const Sweep again = sweep_of(resolved);
  EXPECT_EQ(again.resolved("base.yaml"), resolved);
  EXPECT_EQ(again.size(), 34u);
  EXPECT_EQ(values_of(again), values_of(sweep));
  EXPECT_EQ(again.paths, sweep.paths);
  EXPECT_EQ(again.only.front().text, "energy");
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    ASSERT_EQ(again.run(i).settings.size(), sweep.run(i).settings.size());
    for (std::size_t k = 0; k < sweep.run(i).settings.size(); ++k)
      EXPECT_EQ(again.run(i).settings[k].text, sweep.run(i).settings[k].text);
  }
}

TEST(SweepFile, IdsDoNotDependOnHowManyThereAre) {
  const Sweep sweep = sweep_of(head + "grid: {a: {from: 1, to: 10001, count: 10001}}\n");
  EXPECT_EQ(sweep.run(0).id, "r0001");
  EXPECT_EQ(sweep.run(10000).id, "r10001");
}

TEST(SweepErrors, AreAllShownWithPlaceAndRemedy) {
  EXPECT_EQ(sweep_errors("sweep: 1\nbase: base.yaml\ngrd: {a: [1]}\nzip: {a: [1, 2], b: [3]}\nrepeat: {seeds: 0}\n"),
            "falls.yaml:3:1: error: unknown key `grd` in the sweep\n"
            "   3 | grd: {a: [1]}\n"
            "     | ^~~\n"
            "     = did you mean `grid`?\n"
            "falls.yaml:4:18: error: `b` has 1 values, `a` has 2\n"
            "   4 | zip: {a: [1, 2], b: [3]}\n"
            "     |                  ^\n"
            "     = expected as many for each path: they vary in step\n"
            "falls.yaml:5:17: error: `seeds` is 0\n"
            "   5 | repeat: {seeds: 0}\n"
            "     |                 ^\n"
            "     = expected a whole number from 1 to 1000000\n");
}

TEST(SweepErrors, NameWhatNoSweepCanBe) {
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(sweep_errors(text).find(part), std::string::npos) << sweep_errors(text);
  };
  has(head, "the sweep varies nothing");
  has(head + "grid: {a: []}\n", "`a` has no values");
  has(head + "grid: {a: 3}\n", "expected a list of values, or {from, to, count}");
  has(head + "grid: {a: {from: 1, to: 2}}\n", "has no `count` and no `step`");
  has(head + "grid: {a: {from: 1, to: 2, count: 3, step: 1}}\n", "has both `count` and `step`");
  has(head + "grid: {a: {from: 1, to: 2, count: 1}}\n", "a single value cannot have two ends");
  has(head + "grid: {a: {from: 1, to: 2, step: -1}}\n", "does not lead from 1 to 2");
  has(head + "grid: {a: [1]}\nzip: {a: [2]}\n", "`a` is varied twice");
  has(head + "grid: {a: [1]}\nruns: [{}]\n", "`grid` stands beside `runs`");
  has(head + "grid: {a: [1, 2]}\nskip: [{a: 3}]\n", "no run has these values");
  has(head + "grid: {a: [1, 2]}\nskip: [{a: [1, 2]}]\n", "every run is left out");
  has(head + "grid: {seed: [1, 2]}\nrepeat: {seeds: 2}\n", "`seed` is varied twice: here and by `repeat`");
  has(head + "grid: {a: {from: 1, to: 1000, count: 1000}, b: {from: 1, to: 1001, count: 1001}}\n",
      "more than 1000000 runs");
  std::string many;
  for (int k = 0; k < 40; ++k) many += "  a" + std::to_string(k) + ": {from: 1, to: 1000000, count: 1000000}\n";
  has(head + "grid:\n" + many, "more than 1000000 runs");
  has(head + "zip:\n" + many, "1000000 values of 40 paths");
  has("sweep: 1\nbase: " + std::string(4000, 'b') + "\ngrid: {a: [1]}\n", "cannot be inspected (File name too long):");
  has("sweep: 1\ngrid: {a: [1]}\n", "the sweep has no `base`");
  has("scene: 1\nsimulate: {duration: 1}\n", "this is a scene, not a sweep");
  has("[]", "this is not a sweep");
}

TEST(SweepErrors, ASweepGivenAsASceneIsNamed) {
  EXPECT_NE(errors_of(head + "grid: {a: [1]}\n").find("this is a sweep, not a scene"), std::string::npos);
}

TEST(GridOfTheCommandLine, ReadsRangesAndLists) {
  const Sweep sweep = grid_sweep("base.yaml", {"a=0:1:3", "gravity=[0,0,0],[0,-1,0]", "engine=exact"});
  EXPECT_EQ(values_of(sweep),
            "0 [0, 0, 0] exact; 0 [0, -1, 0] exact; 0.5 [0, 0, 0] exact; 0.5 [0, -1, 0] exact; "
            "1 [0, 0, 0] exact; 1 [0, -1, 0] exact");
  EXPECT_EQ(sweep.base, "base.yaml");
  EXPECT_THROW(grid_sweep("base.yaml", {"a=0:1:x"}), SceneError);
}

}  // namespace
}  // namespace carom
