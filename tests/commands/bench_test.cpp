// carom bench, by the real program.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/program.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const vector<string> quick = {"bench", "balls.yaml", "--steps", "0.1:0.05", "--repeat", "1"};

vector<string> with(vector<string> words, const vector<string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

vector<vector<string>> table_of(const string& text) {
  vector<vector<string>> rows;
  std::istringstream lines(text);
  for (string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST(BenchCommand, SaysThatNothingIndependentChecksIslands) {
  const Workplace here;
  here.write("balls.yaml", R"(scene: 1
gravity: [0, -9.75, 0]
restitution: 0
balls: {b: {mass: 1, radius: 0.25, position: [1.0e-3, 1, 0]}}
obstacles: {o: {radius: 0.75, position: [0, 0, 0]}}
simulate: {duration: 3}
)");

  const Finished run = here.carom(quick);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("exact; rounding and smaller step errors move it by"), string::npos) << run.out;
  EXPECT_NE(run.out.find("\n  islands     no independent check: all methods move bodies in lasting contact"),
            string::npos)
      << run.out;
  EXPECT_EQ(run.out.find("in agreement: "), string::npos) << run.out;

  const Json json = Json::parse(here.carom(with(quick, {"--json", "--force"})).out);
  EXPECT_TRUE(json.at("scenes").at(0).at("reference").at("islands_unchecked")) << json;
}

TEST(BenchCommand, WritesATableAPlotAndAManifest) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.carom(quick);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");

  const auto files = here.files("output/balls.bench");
  ASSERT_EQ(files.size(), 5u);
  const auto table = table_of(files.at("bench.csv"));
  ASSERT_EQ(table.size(), 1u + 1 + 3 * 2 + 2);

  // The columns that other programs rely on.
  const string contract =
      "engine,integrator,step_s,cpu_s,position_error_m,velocity_error_m_per_s,energy_error_J,max_overlap_m,"
      "collisions_missed,collisions_invented,result_hash,";
  EXPECT_TRUE(files.at("bench.csv").starts_with(contract));

  // A row for each engine, integrator and step.
  vector<string> ways;
  for (size_t k = 1; k < table.size(); ++k) ways.push_back(table[k][0] + " " + table[k][1] + " " + table[k][2]);
  EXPECT_EQ(ways,
            (vector<string>{"exact  ", "stepped euler 0.1", "stepped euler 0.05", "stepped verlet 0.1",
                            "stepped verlet 0.05", "stepped rk4 0.1", "stepped rk4 0.05", "book  0.1", "book  0.05"}));

  for (size_t k = 1; k < table.size(); ++k) {
    EXPECT_GT(std::stod(table[k][3]), 0) << k;
    EXPECT_EQ(table[k][10].size(), 16u) << k;
    EXPECT_EQ(table[k][11], "done") << k;
  }

  EXPECT_TRUE(files.at("bench.png").starts_with("\x89PNG"));
  EXPECT_TRUE(files.at("bench.svg").starts_with("<?xml"));
  EXPECT_EQ(here.carom({"run", "output/balls.bench/scene.yaml", "-o", "again"}).code, 0);

  const Json manifest = Json::parse(files.at("manifest.json"));
  EXPECT_EQ(manifest["reference"]["engine"], "exact");
  EXPECT_EQ(manifest["files"].size(), 4u);
  EXPECT_NE(run.out.find("\n  reference   exact; rounding moves it by "), string::npos) << run.out;
  EXPECT_NE(run.out.find("\n  motion      regular: "), string::npos) << run.out;
  EXPECT_NE(run.out.find(
                "\n  wrote       output/balls.bench: bench.csv, bench.png, bench.svg, manifest.json and scene.yaml\n"),
            string::npos)
      << run.out;
}

TEST(BenchCommand, OfACrowdHasACurveOfQualities) {
  SLOW_WITH_SANITIZERS();
  const Workplace here;
  here.write("heap.yaml", R"(scene: 1
seed: 1
restitution: 0.5
room: {min: [0, 0, 0], max: [0.4, 4, 0.4]}
groups: {b: {count: 100, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: [0.4, 2.5, 0.4]}}}
simulate: {duration: 1.2}
)");

  const Finished run = here.carom({"bench", "heap.yaml", "--steps", "0.0625:0.0625", "--budget", "4"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("\n  qualities   of lasting contact of many bodies: means of "), string::npos) << run.out;

  const auto files = here.files("output/heap.bench");
  EXPECT_TRUE(files.at("qualities.png").starts_with("\x89PNG"));
  EXPECT_TRUE(files.at("qualities.svg").starts_with("<?xml"));

  const auto table = table_of(files.at("qualities.csv"));
  ASSERT_GE(table.size(), 4u);
  EXPECT_EQ(table[1][0], "preview");
  EXPECT_EQ(table[3][0], "normal");

  for (size_t k = 1; k < table.size(); ++k) {
    EXPECT_GE(std::stoi(table[k][2]), 3) << k;
    EXPECT_LT(std::stod(table[k][3]), 0.05) << k;
    EXPECT_LT(std::abs(std::stod(table[k][5])), 0.1) << k;
  }

  EXPECT_EQ(table.back()[3], "0");
}

TEST(BenchCommand, JsonHasTheSameRows) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.carom(with(quick, {"--json"}));
  ASSERT_EQ(run.code, 0) << run.err;

  const Json scene = Json::parse(run.out)["scenes"][0];
  const auto table = table_of(here.read("output/balls.bench/bench.csv"));
  ASSERT_EQ(scene["rows"].size() + 1, table.size());

  for (size_t k = 1; k < table.size(); ++k) {
    const Json& row = scene["rows"][k - 1];
    EXPECT_EQ(row["engine"], table[k][0]);
    EXPECT_EQ(row["position_error_m"].get<double>(), std::stod(table[k][4]));
    EXPECT_EQ(row["result_hash"], table[k][10]);
  }

  EXPECT_EQ(scene["status"], "done");
  EXPECT_EQ(scene["chaotic"], false);
}

TEST(BenchCommand, ReplacesABenchOfTheSceneAndNothingElse) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  ASSERT_EQ(here.carom(quick).code, 0);
  EXPECT_EQ(here.carom(with(quick, {"--repeat", "2"})).code, 2);  // given twice
  EXPECT_EQ(here.carom({"bench", "balls.yaml", "--steps", "0.1"}).code, 0);
  EXPECT_EQ(table_of(here.read("output/balls.bench/bench.csv")).size(), 6u);

  ASSERT_EQ(here.carom({"run", "balls.yaml"}).code, 0);
  const auto before = here.files("output");
  for (const auto& words : {with(quick, {"-o", "output/balls"}), with(quick, {"--set", "balls.red.mass=11"})}) {
    const Finished refused = here.carom(words);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("overwrite it with --force"), string::npos) << refused.err;
  }

  EXPECT_EQ(here.carom({"run", "balls.yaml", "-o", "output/balls.bench"}).code, 2);
  EXPECT_EQ(here.files("output"), before);
  EXPECT_EQ(here.carom(with(quick, {"-o", "output/balls", "--force"})).code, 0);
  EXPECT_EQ(here.files("output/balls").size(), 5u);
}

TEST(BenchCommand, WithoutGnuplotRunsNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.shell("PATH=/nowhere \"$CAROM\" bench balls.yaml");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("apt install gnuplot-nox"), string::npos) << run.err;
  EXPECT_FALSE(here.has("output"));
}

TEST(BenchCommand, InterruptedLeavesNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run =
      here.interrupted({"bench", "balls.yaml", "--repeat", "1000", "--budget", "1000"}, "output/balls.bench", SIGINT);
  EXPECT_EQ(run.code, 130);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.ends_with("carom: balls.yaml: interrupted; nothing was written\n")) << run.err;
  EXPECT_FALSE(here.has("output/balls.bench"));
}

TEST(BenchCommand, ThatFailsReportsTheReasonAndLeavesNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished run = here.carom(with(quick, {"--set", "simulate.duration=0"}));
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "carom: balls.yaml: the bench failed: the scene lasts 0 s: there is nothing to measure\n");
  EXPECT_FALSE(here.has("output/balls.bench"));
}

TEST(BenchCommand, RefusesWordsThatMeanNothing) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const auto complaint = [&](const vector<string>& words) {
    const Finished run = here.carom(with({"bench", "balls.yaml"}, words));
    EXPECT_EQ(run.code, 2);
    return run.err.substr(0, run.err.find('\n'));
  };

  EXPECT_EQ(complaint({"--steps", "0.1:x"}), "carom bench: --steps takes a number above 0, not `x`");
  EXPECT_EQ(complaint({"--steps", "0.001:0.1"}),
            "carom bench: --steps takes the longest and the shortest step, such as 0.1:0.001, not `0.001:0.1`");
  EXPECT_EQ(complaint({"--budget", "-1"}), "carom bench: --budget takes a number above 0, not `-1`");
  EXPECT_EQ(complaint({"--reference", "book"}), "carom bench: --reference takes exact, stepped, not `book`");
  EXPECT_EQ(complaint({"--only", "energy"}), "carom bench: no option `--only`");
}

}  // namespace
}  // namespace carom::testing
