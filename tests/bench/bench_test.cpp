// Benches of real scenes: errors fall at the order of the method, chaos is detected, unsupported features are reported.
#include "bench/bench.h"

#include <gtest/gtest.h>

#include "bench/bench_folder.h"
#include "paths.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/simulator.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

constexpr const char* with_rest_length = "forces.0.spring.rest_length=0.1";
constexpr double unlimited = 1e6;  // s, of budget: no row depends on the speed of the machine

Scene scene_of(const string& name, const vector<string>& set = {}) {
  LoadOptions options;
  options.set = set;
  return load_scene(SCENES_DIR "/" + name + ".yaml", options);
}

BenchResult bench(const Scene& scene, double longest, double shortest, double budget = unlimited) {
  BenchOptions options;
  options.longest = longest;
  options.shortest = shortest;
  options.repeat = 1;
  options.budget = budget;
  return run_bench(scene, options, {[] {}, [](double, const string&) {}});
}

vector<BenchRow> rows_of(const BenchResult& result, Engine engine, Integrator integrator = Integrator::rk4) {
  vector<BenchRow> rows;
  for (const BenchRow& row : result.rows)
    if (row.method.engine == engine && (engine != Engine::stepped || row.method.integrator == integrator))
      rows.push_back(row);
  return rows;
}

/// The slope of log error over log step, fitted through all rows.
double order_of(const vector<BenchRow>& rows, double Differences::*error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const BenchRow& row : rows) {
    const double x = log(*row.method.steps.length), y = log((*row.errors).*error);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(rows.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// A spring and impacts. measured: position 0.99, 2.00, 4.00; energy 0.98, 2.00, 5.02: rk4's amplitude is of one order
// more.
TEST(Bench, ErrorsFallByTheOrderOfTheMethod) {
  SLOW_WITH_SANITIZERS();
  const BenchResult result = bench(scene_of("bumper"), 0x1p-6, 0x1p-10);
  EXPECT_EQ(result.reference.engine, Engine::exact);  // sines
  EXPECT_FALSE(result.chaotic);
  const map<Integrator, double> orders = {{Integrator::euler, 1}, {Integrator::verlet, 2}, {Integrator::rk4, 4}};
  for (const auto& [integrator, order] : orders) {
    const auto rows = rows_of(result, Engine::stepped, integrator);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_NEAR(order_of(rows, &Differences::position), order, 0.1);
    EXPECT_GT(order_of(rows, &Differences::energy), order - 0.1);
    for (const BenchRow& row : rows) EXPECT_EQ(row.errors->missed + row.errors->invented, 0u);
  }
}

// measured: dop853 7.6e-12 m; rk4 4.01
TEST(Bench, WherePathsHaveNoClosedFormDop853IsTheReference) {
  SLOW_WITH_SANITIZERS();
  const BenchResult result = bench(scene_of("comet", {"forces.0.attractor.softening=0.1"}), 0x1p-5, 0x1p-8);
  EXPECT_EQ(result.reference.engine, Engine::stepped);
  const auto own = rows_of(result, Engine::stepped, Integrator::dop853);
  const auto rk4 = rows_of(result, Engine::stepped);
  ASSERT_EQ(own.size(), 4u);  // by the error of a step
  EXPECT_LT(own.back().errors->position, 5e-11);
  for (size_t k = 1; k < own.size(); ++k)
    EXPECT_LT(own[k].errors->position, 0.2 * own[k - 1].errors->position);  // measured: 0.13, 1e-3, 5e-2
  ASSERT_EQ(result.witnesses.size(), 2u);  // verlet, rk4: at these steps euler's error exceeds its estimate
  for (const Witness& witness : result.witnesses) EXPECT_TRUE(witness.agrees) << full_name_of(witness.method);
  EXPECT_NEAR(order_of(rk4, &Differences::position), 4, 0.15);
}

// Under linear drag the exact engine has exponentials, the stepped one polynomials.
TEST(Bench, TheExactEngineIsItsOwnReferenceAndItsErrorEstimated) {
  SLOW_WITH_SANITIZERS();
  const BenchResult result = bench(scene_of("raindrops"), 0x1p-6, 0x1p-10);
  EXPECT_EQ(result.reference.engine, Engine::exact);
  ASSERT_EQ(result.witnesses.size(), 4u);  // dop853 by steps, euler, verlet, rk4
  for (const Witness& witness : result.witnesses) EXPECT_TRUE(witness.agrees) << full_name_of(witness.method);
  const auto exact = rows_of(result, Engine::exact), rk4 = rows_of(result, Engine::stepped);
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_FALSE(exact[0].method.steps.length);
  EXPECT_GT(exact[0].errors->position, 0);
  EXPECT_LT(exact[0].errors->position, 1e-11);  // measured: 6e-13
  EXPECT_NEAR(order_of(rk4, &Differences::position), 4, 0.15);
}

TEST(Bench, TheSteppedEngineFindsNoErrorOfTheExactOneInCurvedContact) {
  const BenchResult result = bench(scene_of("rolling_off"), 0x1p-9, 0x1p-11);
  EXPECT_LT(result.rounding, 1e-12);                  // measured: 2e-14
  EXPECT_LT(result.reference_error.position, 1e-12);  // measured: 1.1e-13
}

// In islands all candidates are the same code: agreement among them is no evidence, and an error of their steps is in
// the reference too. By the closed form of the conical pendulum.
TEST(Bench, IslandsHaveNoIndependentCheckButAnErrorOfTheirSteps) {
  SLOW_WITH_SANITIZERS();
  Scene scene;
  scene.world.gravity = Vec3(0, -9.75, 0);
  scene.world.mass = {1};
  scene.world.radius = {0.05};
  scene.world.restitution = {1};
  scene.initial.position = {Vec3(0.6, -0.8, 0)};
  scene.initial.velocity = {Vec3(0, 0, 0.6 * sqrt(9.75 / 0.8))};
  scene.world.strings = {{0, no_entity, Vec3::Zero(), 1}};
  scene.simulate.duration = 500;

  const BenchResult result = bench(scene, 0x1p-3, 0x1p-4);
  EXPECT_TRUE(result.inexact_islands);
  ASSERT_EQ(result.reference.engine, Engine::exact);

  // The string's body goes around in a circle.
  const auto simulator = make_simulator(scene);
  while (simulator->time() < 500) simulator->advance_to(500);
  const double angle = 500 * sqrt(9.75 / 0.8);
  const double off = (simulator->state().position[0] - Vec3(0.6 * std::cos(angle), -0.8, 0.6 * std::sin(angle))).norm();
  EXPECT_LT(off, 10 * result.reference_error.position);  // measured: 5.3e-10, 1.0 times

  for (const char* name : {"raindrops", "two_bowling_balls"})
    EXPECT_FALSE(bench(scene_of(name), 0x1p-6, 0x1p-6).inexact_islands) << name;
  EXPECT_TRUE(bench(scene_of("rolling_off"), 0x1p-9, 0x1p-9).inexact_islands);
}

// Impacts at round times, the last one at the end: velocities differ by 1 m/s around each of them.
TEST(Bench, ImpactsAtRoundTimesMakeNoErrorOfVelocity) {
  const Scene scene = scene_of("newtons_cradle_gap");
  for (const BenchRow& row : bench(scene, 0x1p-5, 0x1p-6).rows) {
    if (row.method.engine == Engine::book) continue;
    EXPECT_LT(row.errors->velocity, 1e-12) << full_name_of(row.method);
    EXPECT_LT(row.errors->position, 1e-12) << full_name_of(row.method);
  }
}

TEST(Bench, TheBookMissesAndInventsCollisionsInLongSteps) {
  const auto rows = rows_of(bench(scene_of("basketball_and_tennis_ball"), 0x1p-4, 0x1p-13), Engine::book);
  ASSERT_EQ(rows.size(), 10u);
  EXPECT_GT(rows.front().errors->missed, 3u);  // of 6
  EXPECT_EQ(rows.back().errors->missed, 0u);
  EXPECT_GT(rows.front().max_overlap + rows[1].max_overlap, 0.1);
  EXPECT_LT(rows.back().max_overlap, 0.001);
  EXPECT_LT(rows.back().errors->position, 0.01);
}

TEST(Bench, AGasIsChaoticAndComparedByItsStatistics) {
  const BenchResult result = bench(scene_of("gas_in_a_room"), 0x1p-4, 0x1p-4);
  EXPECT_TRUE(result.chaotic);
  EXPECT_GT(result.rounding, 0.1);
  EXPECT_GT(result.horizon, 0.2);
  EXPECT_LT(result.horizon, 2);
  EXPECT_EQ(result.members, 13u);

  for (const BenchRow& row : result.rows) {
    if (row.method.engine == Engine::book) {
      EXPECT_GT(row.deviation.value, 10);  // measured: 170; most collisions of a frame are not seen
    } else {
      EXPECT_LT(row.deviation.value, significant_deviation);  // measured: 1.3
      EXPECT_LT(row.errors->position, 1e-9);                  // until the horizon; measured: 3e-12
      EXPECT_EQ(row.errors->missed + row.errors->invented, 0u);
    }
  }
}

TEST(Bench, TheSameGasIsRegularForAWhileAndSoIsABilliardBreak) {
  EXPECT_FALSE(bench(scene_of("gas_in_a_room", {"simulate.duration=0.5"}), 0x1p-4, 0x1p-4).chaotic);
  EXPECT_FALSE(bench(scene_of("billiard_break"), 0x1p-4, 0x1p-4).chaotic);
}

TEST(Bench, ReportsWhatAnEngineDoesNotHave) {
  const BenchResult spring = bench(scene_of("bumper", {with_rest_length}), 0.01, 0.01),
                    clay = bench(scene_of("clay"), 0.01, 0.01);
  EXPECT_EQ(
      spring.left_out,
      (vector<string>{
          "exact: under a `spring` with a rest length or damping paths have no closed form, which `engine: exact` "
          "follows",
          "book: `engine: book` has no forces other than gravity"}));
  EXPECT_EQ(clay.left_out, (vector<string>{"stepped: `integrator: rk4` has no `contact: merge`",
                                           "book: `engine: book` has no `contact: merge`"}));
  EXPECT_EQ(clay.rows.size(), 1u);
}

TEST(Bench, WhatNoEngineHasHasNoReference) {
  BenchOptions options;
  options.reference = Engine::exact;
  EXPECT_THROW(run_bench(scene_of("bumper", {with_rest_length}), options, {[] {}, [](double, const string&) {}}),
               SimulationError);
}

TEST(Bench, ResultsAreTheSameEachTime) {
  const Scene scene = scene_of("basketball_and_tennis_ball");
  const BenchResult once = bench(scene, 0.01, 0.005), again = bench(scene, 0.01, 0.005);
  ASSERT_EQ(once.rows.size(), 9u);
  for (size_t k = 0; k < once.rows.size(); ++k) {
    EXPECT_EQ(once.rows[k].hash, again.rows[k].hash);
    EXPECT_EQ(once.rows[k].errors->position, again.rows[k].errors->position);
    EXPECT_GT(once.rows[k].cpu_s, 0);
  }
}

TEST(Bench, StepsThatCostMoreThanTheBudgetAreLeftOut) {
  NOT_WITH_SANITIZERS();
  const BenchResult result = bench(scene_of("bumper"), 0x1p-4, 0x1p-14, 0.05);
  EXPECT_LT(result.cpu_s, 0.5);
  EXPECT_FALSE(result.left_out.empty());
  EXPECT_LT(rows_of(result, Engine::stepped).size(), 11u);
  EXPECT_GE(rows_of(result, Engine::stepped).size(), 1u);
}

TEST(WorkPrecisionPlot, HasALineForEachMethodAndNoZeros) {
  const Scene scene = scene_of("pyramid");  // nothing moves: the stepped engine's errors are 0
  const BenchResult result = bench(scene, 0.01, 0.0025);
  EXPECT_EQ(rows_of(result, Engine::stepped).back().errors->position, 0);

  const Plot plot = work_precision_plot(scene, result);
  vector<string> names;
  for (const PlotSeries& series : plot.series) names.push_back(series.name);
  EXPECT_EQ(names, (vector<string>{"exact, stepped", "book"}));

  EXPECT_EQ(plot.title, scene.title);
  EXPECT_GT(plot.floor, 1e-17);
  EXPECT_LT(plot.floor, 1e-15);
  EXPECT_EQ(plot.series[0].points.size(), 1u);
  ASSERT_EQ(plot.series[1].points.size(), 3u);
  EXPECT_EQ(plot.series[1].points[0].label, "1/100 s");
  EXPECT_EQ(plot.series[1].points[1].label, "");
  EXPECT_EQ(plot.series[1].points[2].label, "1/400 s");
}

TEST(Bench, ARunThatFailsIsARowWithoutFigures) {
  const auto rows = rows_of(bench(scene_of("book_as_printed"), 0x1p-6, 0x1p-6), Engine::book);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NE(rows[0].failure.find("`red` is 1.374e+11 m from the origin"), string::npos) << rows[0].failure;
}

}  // namespace
}  // namespace carom
