// carom sweep --best, and what compare and sweep say of their runs, by the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

/// A ball thrown at an angle (degrees) lands on the floor at v^2 sin(2 a) / g, after 2 v sin(a) / g.
const string thrown =
    "scene: 1\nlet: {angle: 45, speed: 10, t: '= 2 * speed * sin(angle) / 10'}\ngravity: [0, -10, 0]\n"
    "balls: {ball: {radius: 0.1, mass: 1, position: [0, 0.1, 0], restitution: 0,\n"
    "  velocity: ['= let.speed * cos(let.angle)', '= let.speed * sin(let.angle)', 0]}}\n"
    "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
    "simulate: {duration: 3}\nmeasures: {range: 'max(balls.ball.x_m, until: let.t)'}\noutput: {collisions: true}\n";

void prepare(const Workplace& here) {
  here.write("throw.yaml", thrown);
  here.write("throws.yaml",
             "sweep: 1\ntitle: Throws\nbase: throw.yaml\n"
             "grid: {let.angle: [15, 30, 45, 60, 75], let.speed: [5, 10]}\n");
}

TEST(Best, IsTheRunWithTheHighestValueAndItsValues) {
  const Workplace here;
  prepare(here);
  const Finished run = here.carom({"sweep", "throws.yaml", "--best", "range"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("  best        10 of `range` in r0006 (let.angle = 45, let.speed = 10)\n"), string::npos)
      << run.out;
  // 25 sin(30 degrees) / 10 is 1.25, at 15 and at 75 degrees.
  EXPECT_NE(run.out.find("  found       range from 1.25 (r0001 and 1 more) to 10 (r0006), mostly by speed (+"),
            string::npos)
      << run.out;
}

TEST(Best, TakesAnExpressionOfMeasuresAndAsksAFinishedSweep) {
  const Workplace here;
  prepare(here);
  ASSERT_EQ(here.carom({"sweep", "throws.yaml"}).code, 0);
  const Finished run = here.carom({"sweep", "throws.yaml", "--best", "-(range - 5)^2"});
  ASSERT_EQ(run.code, 0) << run.err;
  // No run is made again: 10 sin(30 degrees) is 5.
  EXPECT_NE(run.out.find("  made        0 runs"), string::npos) << run.out;
  EXPECT_NE(run.out.find(" of `= -(range - 5)^2` in r0002 (let.angle = 15, let.speed = 10), and 1 more"), string::npos)
      << run.out;

  // Once more it is up to date, and still answers.
  const Finished again = here.carom({"sweep", "throws.yaml", "--best", "-(range - 5)^2"});
  EXPECT_NE(again.out.find("up to date"), string::npos) << again.out;
  EXPECT_NE(again.out.find(" in r0002 (let.angle = 15, let.speed = 10), and 1 more"), string::npos) << again.out;
}

TEST(Best, IsInTheDocumentOfJson) {
  const Workplace here;
  prepare(here);
  const Json json = Json::parse(here.carom({"sweep", "throws.yaml", "--json", "--best", "range"}).out);
  ASSERT_EQ(json["found"].size(), 1u);
  EXPECT_EQ(json["found"][0]["measure"], "range");
  EXPECT_EQ(json["found"][0]["highest"]["run"], "r0006");
  EXPECT_NEAR(json["found"][0]["highest"]["value"].get<double>(), 10, 1e-12);
  EXPECT_EQ(json["found"][0]["highest"]["values"]["let.angle"], "45");
  EXPECT_EQ(json["found"][0]["strongest"], "let.speed");
  EXPECT_EQ(json["best"]["run"], "r0006");

  // Undefined in all runs.
  EXPECT_TRUE(Json::parse(here.carom({"sweep", "throws.yaml", "--json", "--best", "range / 0"}).out)["best"].is_null());
}

TEST(Best, OfABlockWithoutThePathHasTheValueOfTheBasesDefaults) {
  const Workplace here;
  here.write("drop.yaml",
             "scene: 1\ngravity: [0, -10, 0]\ndefaults: {ball: {restitution: 0.9}}\n"
             "balls: {ball: {radius: 0.1, mass: 1, position: [0, 1.1, 0]}}\n"
             "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: 0.6}\n");
  here.write("drops.yaml",
             "sweep: 1\nbase: drop.yaml\nlist: [{defaults.ball.restitution: 0.1}, {balls.ball.mass: 2}]\n"
             "compare: {measures: [energy_lost_J]}\n");
  ASSERT_EQ(here.carom({"sweep", "drops.yaml", "-o", "out"}).code, 0);
  EXPECT_NE(here.read("out/summary.csv").find(",0.1,1\n"), string::npos) << here.read("out/summary.csv");
  EXPECT_NE(here.read("out/summary.csv").find(",0.9,2\n"), string::npos) << here.read("out/summary.csv");
}

TEST(Best, OfWhatIsNoMeasureIsAnErrorBeforeAnythingIsRun) {
  const Workplace here;
  prepare(here);
  const Finished run = here.carom({"sweep", "throws.yaml", "--best", "rnge * 2"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("--best: error: `= rnge * 2`: no number is named `rnge`"), string::npos) << run.err;
  EXPECT_TRUE(here.files("output").empty());
}

}  // namespace
}  // namespace carom::testing
