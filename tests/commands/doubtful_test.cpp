// Runs with wrong energy balances are reported as doubtful everywhere; runs that cannot go on end with a remedy.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const string ball = "scene: 1\ngravity: [0, 0, 0]\nballs: {a: {mass: 1, radius: 0.01, position: [1, 0, 0]}}\n";
const string spring = "forces: [{spring: {anchor: [0, 0, 0], stiffness: 1e4}}]\n";

/// A scene that is doubtful: rk4 takes most of the energy of a spring whose period is five steps.
string damped(const string& step) {
  return ball + spring + "simulate: {duration: 2, engine: stepped, integrator: rk4, step: " + step + "}\n";
}

TEST(Doubtful, RunsAreMarkedInTheReportTheManifestJsonAndSummary) {
  const Workplace here;
  here.write("damped.yaml", damped("0.012"));
  const Finished run = here.carom({"run", "damped.yaml"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("\n  doubtful    the method lost "), string::npos) << run.out;
  EXPECT_NE(
      run.out.find("\n  doubtful    forces turned by 1.2 rad in a step of 0.012 s, most by forces.0.spring on `a`"),
      string::npos)
      << run.out;
  EXPECT_NE(here.read("output/damped/summary.csv").find(",stepped,doubtful,2,"), string::npos);

  const Json manifest = Json::parse(here.read("output/damped/manifest.json"));
  EXPECT_EQ(manifest.at("status"), "doubtful");
  ASSERT_EQ(manifest.at("warnings").size(), 2u);
  EXPECT_EQ(manifest.at("warnings")[0].at("code"), "energy");
  EXPECT_EQ(manifest.at("warnings")[1].at("code"), "step");

  const Json again = Json::parse(here.carom({"run", "damped.yaml", "--json"}).out).at("scenes").at(0);
  EXPECT_EQ(again.at("status"), "up to date");
  EXPECT_EQ(again.at("warnings"), manifest.at("warnings"));

  const Json fresh = Json::parse(here.carom({"run", "damped.yaml", "--json", "--force"}).out).at("scenes").at(0);
  EXPECT_EQ(fresh.at("summary").at("status"), "doubtful");
  EXPECT_EQ(fresh.at("warnings"), manifest.at("warnings"));

  const Finished quiet = here.carom({"run", "damped.yaml", "-q", "--force"});
  EXPECT_EQ(quiet.out, "");
  EXPECT_NE(quiet.err.find("carom: damped.yaml: doubtful: the method lost "), string::npos) << quiet.err;
}

TEST(Doubtful, IsNoRunWithAGoodStep) {
  const Workplace here;
  here.write("fine.yaml", damped("0.0005"));
  const Finished run = here.carom({"run", "fine.yaml"});
  EXPECT_EQ(run.out.find("doubtful"), string::npos) << run.out;
  EXPECT_NE(here.read("output/fine/summary.csv").find(",stepped,done,2,"), string::npos);
}

TEST(Doubtful, RunsOfASweepAreCountedAndMarked) {
  const Workplace here;
  here.write("damped.yaml", damped("0.012"));
  here.write("steps.yaml", "sweep: 1\nbase: damped.yaml\ngrid: {simulate.step: [0.0005, 0.012]}\n");
  const Finished run = here.carom({"sweep", "steps.yaml"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("\n  doubtful    1 run: "), string::npos) << run.out;
  const string table = here.read("output/steps/summary.csv");
  EXPECT_NE(table.find("r0001,,stepped,done"), string::npos) << table;
  EXPECT_NE(table.find("r0002,,stepped,doubtful"), string::npos) << table;
}

TEST(Doubtful, StepsThatMakeEnergyWithoutEndEndTheRun) {
  const Workplace here;
  here.write("burst.yaml",
             ball + spring + "simulate: {duration: 20, engine: stepped, integrator: verlet, step: 0.0201}\n");
  const Finished run = here.carom({"run", "burst.yaml"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("at t = "), string::npos);
  EXPECT_NE(run.err.find(" s `a` is "), string::npos) << run.err;
  EXPECT_NE(run.err.find("simulate.step are too long for the forces: shorten"), string::npos) << run.err;
  EXPECT_FALSE(here.has("output/burst/summary.csv"));
}

TEST(Doubtful, AToleranceThatIsNotMetIsReported) {
  const Workplace here;
  string scene = "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [-1, -1, -1], max: [1, 1, 1], restitution: 1}\nballs:\n";
  for (int k = 0; k < 12; ++k)
    scene += "  b" + to_string(k) + ": {mass: 1, radius: 0.15, position: [" + to_string(-0.75 + 0.5 * (k % 4)) + ", " +
             to_string(-0.5 + 0.5 * (k / 4)) + ", " + to_string(0.01 * k) + "], velocity: [" +
             to_string(0.3 * (k % 3) - 0.2) + ", " + to_string(0.25 * (k % 5) - 0.4) + ", 0.3]}\n";
  here.write("crowd.yaml", scene + "simulate: {duration: 80, tolerance: 1e-6}\n");
  const Finished run = here.carom({"run", "crowd.yaml"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("doubtful    positions are right to 1e-06 m until "), string::npos) << run.out;
  EXPECT_NE(run.out.find("chaotic, a disturbance grows"), string::npos) << run.out;
}

TEST(Accuracy, CheckReportsTheErrorAndItsParts) {
  const Workplace here;
  here.write("damped.yaml", damped("0.0005"));
  const Finished check = here.carom({"check", "damped.yaml", "--accuracy"});
  EXPECT_EQ(check.code, 0) << check.err;
  for (const char* label : {"accuracy", "rounding", "integrator", "contact", "chaos"})
    EXPECT_NE(check.out.find(string("\n  ") + label), string::npos) << check.out;
  const Json json = Json::parse(here.carom({"check", "damped.yaml", "--accuracy", "--json"}).out);
  const Json& accuracy = json.at("scenes").at(0).at("accuracy");
  EXPECT_GT(accuracy.at("rounding_m"), 0);
  EXPECT_LT(accuracy.at("rounding_m"), 1e-11);
  EXPECT_FALSE(accuracy.at("chaotic"));
}

/// A ball that strikes two touching ones on their axis: rigid bodies alone leave the outcome open.
TEST(Accuracy, CheckSaysWhatTheLawOfImpactsAtOneInstantIsWorth) {
  const Workplace here;
  here.write("three.yaml", R"(scene: 1
balls:
  cue: {mass: 1, radius: 0.5, position: [-3, 0, 0], velocity: [10, 0, 0]}
  up: {mass: 1, radius: 0.5, position: [0, 0.5, 0]}
  low: {mass: 1, radius: 0.5, position: [0, -0.5, 0]}
simulate: {duration: 1}
)");

  const Finished run = here.carom({"run", "three.yaml"});
  EXPECT_NE(run.out.find("at once     rigid bodies leave 1 instant open with several impacts on a body"), string::npos)
      << run.out;
  EXPECT_NE(run.out.find("`low` at 0.2134 s"), string::npos) << run.out;

  // Together each ball leaves at 4 sqrt(3) m/s. One by one the second one has 2.5 sqrt(3) m/s.
  const Finished check = here.carom({"check", "three.yaml", "--accuracy"});
  EXPECT_NE(check.out.find("until the end, under carom's law for impacts"), string::npos) << check.out;

  const Json json = Json::parse(here.carom({"check", "three.yaml", "--accuracy", "--json"}).out);
  const double order = json.at("scenes").at(0).at("accuracy").at("order_m");
  EXPECT_NEAR(order, 1.5 * sqrt(3.0) * (0.7 + 0.05 * sqrt(3.0)), 1e-12);

  // From one side there is one impact after the other in any order.
  here.write("row.yaml", R"(scene: 1
balls:
  cue: {mass: 1, radius: 0.5, position: [-3, 0, 0], velocity: [10, 0, 0]}
  b: {mass: 1, radius: 0.5, position: [0, 0, 0]}
  c: {mass: 1, radius: 0.5, position: [1, 0, 0]}
simulate: {duration: 1}
)");

  const Finished row = here.carom({"check", "row.yaml", "--accuracy"});
  EXPECT_NE(row.out.find("rigid bodies leave no impacts of one instant open"), string::npos) << row.out;
}

TEST(Accuracy, CheckComparesStepErrorsWhereIslandsHaveThem) {
  const Workplace here;
  const string swing = R"(scene: 1
gravity: [0, -9.75, 0]
balls: {b: {mass: 1, radius: 0.05, position: ['= sin(10)', '= -cos(10)', 0]}}
strings: {s: {from: [0, 0, 0], to: b}}
simulate: {duration: 5}
)";

  here.write("swing.yaml", swing);
  const Finished check = here.carom({"check", "swing.yaml", "--accuracy"});
  EXPECT_NE(check.out.find("m at most, between runs with two step errors"), string::npos) << check.out;

  here.write("slack.yaml", string(swing)
                               .replace(swing.find("duration: 5"), 11, "duration: 0.3")
                               .replace(swing.find("to: b"), 5, "to: b, length: 2"));
  const Finished slack = here.carom({"check", "slack.yaml", "--accuracy"});
  EXPECT_NE(slack.out.find("closed forms: no step error"), string::npos) << slack.out;
}

}  // namespace
}  // namespace carom::testing
