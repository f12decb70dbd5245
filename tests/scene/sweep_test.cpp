// Sweep files and their runs.
#include "scene/sweep.h"

#include "scene/marked_errors.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

const string head = "sweep: 1\nbase: base.yaml\n";

Sweep sweep_of(const string& text) {
  write_file("", "base.yaml");
  const string path = write_file(text, "falls.yaml");
  Sweep sweep = load_sweep(path);
  std::filesystem::remove_all(test_folder());
  return sweep;
}

/// The values of every run: "a b; a b".
string values_of(const Sweep& sweep) {
  string out;
  for (size_t i = 0; i < sweep.size(); ++i) {
    string line;
    for (const auto& value : sweep.run(i).values) line += (line.empty() ? "" : " ") + value.value_or("-");
    out += (out.empty() ? "" : "; ") + line;
  }
  return out;
}

string sweep_errors(const string& text) {
  const string folder = test_folder() + "/";
  try {
    sweep_of(text);
    return "";
  } catch (const SceneError& error) {
    string out = error.what();
    for (size_t i = out.find(folder); i != string::npos; i = out.find(folder, i)) out.erase(i, folder.size());
    return out;
  }
}

TEST(SweepFile, GridIsEveryCombinationTheLastPathFastest) {
  const Sweep sweep = sweep_of(head + "grid:\n  a.x: {from: 0.5, to: 0.7, count: 3}\n  b: [1, 2]\n");
  EXPECT_EQ(sweep.paths, (vector<string>{"a.x", "b"}));
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
  const string grid = "grid: {a: [1, 2, 3], b: [0.50, 0.6]}\n";
  EXPECT_EQ(values_of(sweep_of(head + grid + "skip: [{a: 2, b: 0.5}]\n")), "1 0.50; 1 0.6; 2 0.6; 3 0.50; 3 0.6");
  EXPECT_EQ(values_of(sweep_of(head + grid + "skip: [{a: [1, 3]}, {b: 0.6}]\n")), "2 0.50");
}

TEST(SweepFile, SamplesMultiplyWithAGridAndAreThoseOfTheSeed) {
  const string text = head + "random: 3\nover: {b: {from: 1, to: 5}, c: {from: 1, to: 9, log: true}}\n";
  const Sweep three = sweep_of(text);
  EXPECT_EQ(three.paths, (vector<string>{"b", "c"}));
  EXPECT_EQ(values_of(three), values_of(sweep_of(text + "seed: 0\n")));
  EXPECT_NE(values_of(three), values_of(sweep_of(text + "seed: 1\n")));
  const Sweep six = sweep_of(text + "grid: {a: [1, 2]}\n");
  ASSERT_EQ(six.size(), 6u);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(six.run(i).values[0], i < 3 ? "1" : "2");
    EXPECT_EQ(six.run(i).values[1], three.run(i % 3).values[0]);
  }
}

TEST(SweepFile, SamplesOfAPathDoNotDependOnOtherPathsButOnTheBlock) {
  const Sweep one = sweep_of(head + "latin: 4\nover: {b: {from: 1, to: 5}}\n");
  const Sweep two = sweep_of(head + "latin: 4\nover: {a: {from: 0, to: 1}, b: {from: 1, to: 5}}\n");
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(one.run(i).values[0], two.run(i).values[1]);
  const Sweep blocks = sweep_of(head +
                                "runs:\n  - {latin: 4, over: {b: {from: 1, to: 5}}}\n"
                                "  - {latin: 4, over: {b: {from: 1, to: 5}}}\n");
  EXPECT_EQ(blocks.run(0).values, one.run(0).values);
  EXPECT_NE(blocks.run(4).values, one.run(0).values);
}

TEST(SweepFile, SamplesOfAKeyOfWholeNumbersAreWhole) {
  const Sweep sweep = sweep_of(head + "random: 20\nover: {groups.gas.count: {from: 3, to: 5}}\n");
  for (size_t i = 0; i < 20; ++i) {
    const string count = sweep.run(i).values[0].value_or("");
    EXPECT_TRUE(count == "3" || count == "4" || count == "5") << count;
  }
}

TEST(SweepFile, SamplesOfARepeatOfItsIndicesAndOfSizesInPixelsAreWhole) {
  for (const char* path :
       {"balls.row.repeat", "balls.row.repeat.i", "strings.row.repeat.j", "output.frames.size.width"})
    for (const char* log : {"", ", log: true"}) {
      const Sweep sweep = sweep_of(head + "latin: 20\nover: {" + path + ": {from: 20, to: 22" + log + "}}\n");
      for (size_t i = 0; i < 20; ++i) {
        const string count = sweep.run(i).values[0].value_or("");
        EXPECT_TRUE(count == "20" || count == "21" || count == "22") << path << ": " << count;
      }
    }
  EXPECT_NE(sweep_errors(head + "random: 5\nover: {balls.row.repeat: {from: 1, to: 2.5}}\n")
                .find("`balls.row.repeat` takes whole numbers"),
            string::npos);
}

TEST(SweepFile, SamplesOfANameOfLetAreReal) {
  const Sweep sweep = sweep_of(head + "random: 20\nover: {let.repeat: {from: 1, to: 3}}\n");
  for (size_t i = 0; i < 20; ++i)
    EXPECT_NE(sweep.run(i).values[0].value_or("").find('.'), string::npos) << sweep.run(i).values[0].value_or("");
}

TEST(SweepErrors, OfSamplesHavePlaceAndRemedy) {
  const auto has = [](const string& text, const string& part) {
    EXPECT_NE(sweep_errors(head + text).find(part), string::npos) << sweep_errors(head + text);
  };
  has("random: 5\n", "falls.yaml:3:1: error: the sweep has `random` but no `over`");
  has("over: {a: {from: 1, to: 2}}\n", "falls.yaml:3:1: error: the sweep has `over` but no `random`");
  has("random: 5\nlatin: 5\nover: {a: {from: 1, to: 2}}\n", "has both `random` and `latin`");
  has("random: 0\nover: {a: {from: 1, to: 2}}\n", "`random` is 0");
  has("random: 1.5\nover: {a: {from: 1, to: 2}}\n", "expected a whole number from 1 to 1000000");
  has("random: 5\nover: {a: {from: 1}}\n", "has no `to`");
  has("random: 5\nover: {a: [1, 2]}\n", "expected a map of keys");
  has("random: 5\nover: {}\n", "has no entries");

  has("random: 5\nover: {a: {from: 1, to: 2, count: 3}}\n", "unknown key `count`");
  has("random: 5\nover: {a: {from: 2, to: 2}}\n", "falls.yaml:4:25: error: no number lies between 2 and 2");
  has("random: 5\nover: {a: {from: 2, to: 1}}\n", "expected `from` below `to`");
  has("random: 5\nover: {a: {from: 0, to: 1, log: true}}\n", "0 has no logarithm");
  has("random: 5\nover: {seed: {from: 0.5, to: 7}}\n", "falls.yaml:4:21: error: `seed` takes whole numbers");
  has("random: 5\nover: {a: {from: 1, to: 1.00000000000000001}}\n", "no number lies between");

  has("random: 5\nover: {a: {from: 1, to: 1.000000000000001}}\n", "the numbers of `a` have more than 15 digits");

  // A million values of eleven paths.
  string ranges;
  for (int k = 0; k < 11; ++k) ranges += (k > 0 ? ", a" : "a") + to_string(k) + ": {from: 1, to: 2}";
  has("random: 1000000\nover: {" + ranges + "}\n", "expected at most 10000000 values in all");

  has("random: 5\ngrid: {a: [1]}\nover: {a: {from: 1, to: 2}}\n", "`a` is varied twice");
  has("random: 1000\ngrid: {b: {from: 1, to: 1001, count: 1001}}\nover: {a: {from: 1, to: 2}}\n",
      "more than 1000000 runs");
  has("grid: {a: [1, 2]}\nseed: 3\n", "falls.yaml:4:1: error: `seed` is that of `random` and `latin`");
  has("random: 5\nover: {a: {from: 1, to: 2}}\nruns: [{}]\n", "`random` stands beside `runs`");
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
  const string text = head +
                      "title: 'He said \"go\"'\nset: {x: '#ff0000'}\n"
                      "runs:\n  - grid: {a: {from: 0, to: 1, count: 3}, b: [[0, 1, 0], exact]}\n"
                      "    zip: {c: [1, 2], d: [3, 4]}\n    list: [{e: 1}, {f: \"2\"}]\n"
                      "    skip: [{a: 0.5, c: [1, 2]}]\n  - {}\n"
                      "  - {latin: 3, over: {b: {from: 1, to: 2}, 'a': {log: true, from: 1, to: 2}}}\n"
                      "seed: 5\nskip_invalid: true\n"
                      "repeat: {seeds: 2, first: 7}\nonly: [energy]\n"
                      "compare: {measures: [collisions], charts: [{x: a, y: collisions, by: b}]}\n";

  const Sweep sweep = sweep_of(text);
  const string resolved = sweep.resolved("base.yaml");
  const Sweep again = sweep_of(resolved);
  EXPECT_EQ(again.resolved("base.yaml"), resolved);
  EXPECT_EQ(again.size(), 40u);
  EXPECT_EQ(values_of(again), values_of(sweep));
  EXPECT_EQ(again.paths, sweep.paths);
  EXPECT_EQ(again.only.front().text, "energy");

  for (size_t i = 0; i < sweep.size(); ++i) {
    ASSERT_EQ(again.run(i).settings.size(), sweep.run(i).settings.size());
    for (size_t k = 0; k < sweep.run(i).settings.size(); ++k)
      EXPECT_EQ(again.run(i).settings[k].text, sweep.run(i).settings[k].text);
  }
}

TEST(SweepFile, IdsDoNotDependOnHowManyThereAre) {
  const Sweep sweep = sweep_of(head + "grid: {a: {from: 1, to: 10001, count: 10001}}\n");
  EXPECT_EQ(sweep.run(0).id, "r0001");
  EXPECT_EQ(sweep.run(10000).id, "r10001");
}

TEST(SweepErrors, AreAllShownWithPlaceAndRemedy) {
  EXPECT_EQ(in_parts(sweep_errors(
                "sweep: 1\nbase: base.yaml\ngrd: {a: [1]}\nzip: {a: [1, 2], b: [3]}\nrepeat: {seeds: 0}\n")),
            (Parts{{"3:1 grd", "unknown key `grd` in the sweep", "did you mean `grid`?"},
                   {"4:18 b", "`b` has 1 value, `a` has 2", "expected as many for each path: they vary in step"},
                   {"5:17 0", "`seeds` is 0", "expected a whole number from 1 to 1000000"}}));
}

TEST(SweepErrors, NameWhatNoSweepCanBe) {
  SLOW_WITH_SANITIZERS();
  const auto has = [](const string& text, const string& part) {
    EXPECT_NE(sweep_errors(text).find(part), string::npos) << sweep_errors(text);
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

  // More runs than 64 bits count.
  string many;
  for (int k = 0; k < 40; ++k) many += "  a" + to_string(k) + ": {from: 1, to: 1000000, count: 1000000}\n";
  has(head + "grid:\n" + many, "more than 1000000 runs");
  has(head + "zip:\n" + many, "1000000 values of 40 paths");

  has("sweep: 1\nbase: " + string(4000, 'b') + "\ngrid: {a: [1]}\n", "cannot be inspected (File name too long):");
  has("sweep: 1\ngrid: {a: [1]}\n", "the sweep has no `base`");
  has("scene: 1\nsimulate: {duration: 1}\n", "this is a scene, not a sweep");
  has("[]", "this is not a sweep");
}

TEST(SweepErrors, ASweepGivenAsASceneIsNamed) {
  EXPECT_NE(errors_of(head + "grid: {a: [1]}\n").find("this is a sweep, not a scene"), string::npos);
}

TEST(GridOfTheCommandLine, ReadsRangesAndLists) {
  const Sweep sweep = grid_sweep("base.yaml", {"a=0:1:3", "gravity=[0,0,0],[0,-1,0]", "engine=exact"});
  EXPECT_EQ(values_of(sweep),
            "0 [0, 0, 0] exact; 0 [0, -1, 0] exact; 0.5 [0, 0, 0] exact; 0.5 [0, -1, 0] exact; "
            "1 [0, 0, 0] exact; 1 [0, -1, 0] exact");
  EXPECT_EQ(sweep.base, "base.yaml");
  EXPECT_THROW(grid_sweep("base.yaml", {"a=0:1:x"}), SceneError);
}

TEST(GridOfTheCommandLine, DrawsFromRangesWithoutACount) {
  SweepOptions options;
  options.latin = 3;
  const Sweep sweep = grid_sweep("base.yaml", {"a=1,2", "b=0:1", "c=1:10:log"}, options);
  EXPECT_EQ(sweep.paths, (vector<string>{"a", "b", "c"}));
  EXPECT_EQ(sweep.size(), 6u);
  const Sweep file =
      sweep_of(head + "grid: {a: [1, 2]}\nlatin: 3\nover: {b: {from: 0, to: 1}, c: {from: 1, to: 10, log: true}}\n");
  EXPECT_EQ(values_of(sweep), values_of(file));
  options.seed = 7;
  EXPECT_NE(values_of(grid_sweep("base.yaml", {"a=1,2", "b=0:1", "c=1:10:log"}, options)), values_of(sweep));
}

}  // namespace
}  // namespace carom
