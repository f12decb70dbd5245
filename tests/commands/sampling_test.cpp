// carom sweep with samples, repeats and measures of the command line, and with invalid scenarios left out.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;
using Files = map<string, string>;

/// The files that must not depend on how a sweep was run: without the runs' manifests, which have times.
Files lasting(const Workplace& here, const string& folder) {
  Files files;
  for (const auto& [name, bytes] : here.files(folder))
    if (!name.starts_with("runs/") || !name.ends_with("manifest.json")) files[name] = bytes;
  return files;
}

const string latin =
    "sweep: 1\nbase: balls.yaml\nlatin: 9\nover: {balls.red.mass: {from: 1, to: 50, log: true}, "
    "balls.red.position.z: {from: -0.05, to: 0.05}}\nseed: 3\nonly: [energy]\n";

TEST(SampledSweep, HasTheSameBytesInPartsAndForAnyNumberOfJobs) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("latin.yaml", latin);
  EXPECT_EQ(here.carom({"sweep", "latin.yaml", "-o", "one", "-j", "1", "-q"}).code, 0);
  EXPECT_EQ(here.carom({"sweep", "latin.yaml", "-o", "three", "-j", "3", "-q"}).code, 0);
  for (const string part : {"2/2", "1/2"})
    EXPECT_EQ(here.carom({"sweep", "latin.yaml", "-o", "parts", "--shard", part, "-q"}).code, 0);
  const Finished gather = here.carom({"gather", "parts", "-q"});
  EXPECT_EQ(gather.code, 0) << gather.err;
  EXPECT_EQ(lasting(here, "three"), lasting(here, "one"));
  EXPECT_EQ(lasting(here, "parts"), lasting(here, "one"));
}

TEST(SampledSweep, OfTheCommandLineIsThatOfAFile) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("latin.yaml", latin);
  here.carom({"sweep", "latin.yaml", "-o", "file", "-q"});

  const Finished words = here.carom({"sweep", "balls.yaml", "--latin", "9", "--grid", "balls.red.mass=1:50:log",
                                     "--grid", "balls.red.position.z=-0.05:0.05", "--only", "energy", "--seed", "3",
                                     "--measures", "balls.blue.x_m", "-q"});
  EXPECT_EQ(words.code, 0) << words.err;
  for (const string run : {"r0001", "r0009"})
    EXPECT_EQ(here.read("output/balls.sweep/runs/" + run + "/energy.csv"),
              here.read("file/runs/" + run + "/energy.csv"));

  const string rows = here.read("output/balls.sweep/summary.csv");
  EXPECT_TRUE(rows.substr(0, rows.find('\n')).ends_with("balls.red.mass,balls.red.position.z,balls.blue.x_m")) << rows;
}

TEST(SampledSweep, RangesAndNumbersOfSamplesNeedEachOther) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("latin.yaml", latin);

  const auto refused = [&](vector<string> words, const string& part) {
    words.insert(words.begin(), "sweep");
    const Finished sweep = here.carom(words);
    EXPECT_EQ(sweep.code, 2);
    EXPECT_NE(sweep.err.find(part), string::npos) << sweep.err;
  };

  refused({"balls.yaml", "--grid", "balls.red.mass=1:2"}, "add one, such as balls.red.mass=1:2:6, or draw from it");
  refused({"balls.yaml", "--latin", "5"}, "there are none: add --grid PATH=FROM:TO");
  refused({"balls.yaml", "--latin", "5", "--random", "5", "--grid", "balls.red.mass=1:2"}, "exclude one another");
  refused({"latin.yaml", "--latin", "5"}, "latin.yaml is a sweep: add to its `random` or `latin`");
  refused({"balls.yaml", "--random", "0", "--grid", "balls.red.mass=1:2"}, "--random takes a whole number from 1");
  refused({"balls.yaml", "--random", "3", "--grid", "balls.red.mas=1:2"}, "did you mean `mass`?");
  refused({"balls.yaml", "--grid", "balls.red.mass=1,2", "--measures", "balls.rd.x_m"}, "did you mean");
}

TEST(RepeatOption, RunsSeedsFromTheScenesOn) {
  const Workplace here;
  here.write("balls.yaml", two_balls("seed: 5\n" + tables));
  EXPECT_EQ(here.carom({"sweep", "balls.yaml", "--repeat", "3", "--only", "energy", "-q"}).code, 0);
  const string rows = here.read("output/balls.sweep/summary.csv");
  for (const string end : {",5\n", ",6\n", ",7\n"}) EXPECT_NE(rows.find(end), string::npos) << rows;
  here.write("grid.yaml", "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: [1, 2]}\nrepeat: {seeds: 2, first: 0}\n");
  const Finished plan = here.carom({"sweep", "grid.yaml", "--repeat", "3", "--plan", "--json"});
  const Json document = Json::parse(plan.out);
  ASSERT_EQ(document.at("runs").size(), 6u);
  EXPECT_EQ(document.at("runs").at(5).at("values").at("seed"), 2);
}

const string mass_sweep = "sweep: 1\nbase: balls.yaml\ngrid: {balls.red.mass: [0, 1, -1, 2]}\nonly: [energy]\n";

TEST(SkipInvalid, LeavesOutInvalidScenariosAndKeepsTheIdsOfTheOthers) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("masses.yaml", mass_sweep);
  EXPECT_EQ(here.carom({"sweep", "masses.yaml", "-q"}).code, 2);
  EXPECT_FALSE(here.has("output"));

  const Finished sweep = here.carom({"sweep", "masses.yaml", "--skip-invalid"});
  EXPECT_EQ(sweep.code, 0) << sweep.err;
  EXPECT_NE(sweep.out.find("  left out    2 invalid runs\n              r0001: `mass` is 0\n"), string::npos)
      << sweep.out;
  EXPECT_FALSE(here.has("output/masses/runs/r0001"));
  EXPECT_EQ(here.read("output/masses/skipped.csv"), "run,error\nr0001,`mass` is 0\nr0003,`mass` is -1\n");

  const string rows = here.read("output/masses/summary.csv");
  EXPECT_EQ(ranges::count(rows, '\n'), 3);
  EXPECT_NE(rows.find("\nr0004,"), string::npos);

  // They are named again, and nothing is run.
  const Finished again = here.carom({"sweep", "masses.yaml", "--skip-invalid"});
  EXPECT_NE(again.out.find("up to date  2 runs"), string::npos) << again.out;
  EXPECT_NE(again.out.find("r0003: `mass` is -1"), string::npos) << again.out;

  // The rest can be compared.
  const Finished compare = here.carom({"compare", "output/masses", "-q"});
  EXPECT_EQ(compare.code, 0) << compare.err;
}

TEST(SkipInvalid, HasTheSameBytesInParts) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  here.write("masses.yaml", mass_sweep + "skip_invalid: true\n");
  EXPECT_EQ(here.carom({"sweep", "masses.yaml", "-o", "whole", "-q"}).code, 0);
  for (const string part : {"1/3", "2/3", "3/3"})
    EXPECT_EQ(here.carom({"sweep", "masses.yaml", "-o", "part" + part.substr(0, 1), "--shard", part, "-q"}).code, 0);
  const Finished gather = here.carom({"gather", "all", "part1", "part2", "part3", "-q"});
  EXPECT_EQ(gather.code, 0) << gather.err;
  EXPECT_EQ(lasting(here, "all"), lasting(here, "whole"));
}

TEST(SkipInvalid, RefusesASweepWithoutAnyValidScenario) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished sweep = here.carom({"sweep", "balls.yaml", "--grid", "balls.red.mas=1,2", "--skip-invalid", "--json"});
  EXPECT_EQ(sweep.code, 2);
  EXPECT_FALSE(here.has("output"));
  const Json errors = Json::parse(sweep.out).at("errors");
  ASSERT_GE(errors.size(), 1u);
  EXPECT_EQ(errors.at(0).at("near"), "mass");
}

}  // namespace
}  // namespace carom::testing
