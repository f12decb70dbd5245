// Bodies that come into the world after the start: when, where, with what energy, and what waits for room.
#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/random.h"
#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

/// Lets body i come at a time (s).
void appear(Problem& problem, Entity i, double time) {
  problem.world.appears.resize(problem.world.body_count(), -infinity);
  problem.world.appears[i] = time;
}

/// When each body appears (s); NaN: it does not.
vector<double> appearances(const Problem& problem, Outcome* end = nullptr) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  vector<double> times(problem.world.body_count(), numeric_limits<double>::quiet_NaN());
  while (simulator->time() < problem.options.duration) {
    simulator->advance_to(problem.options.duration);
    for (const RegionCrossing& crossing : simulator->crossings())
      if (crossing.region == RegionCrossing::world) times[crossing.body] = crossing.time;
  }
  if (end != nullptr) *end = {{}, {}, simulator->state(), simulator->tally()};
  return times;
}

/// J, that the balance leaves.
double unaccounted(const Problem& problem, const Outcome& run) {
  State start = problem.initial;
  start.mass = problem.world.mass;
  for (Entity i = 0; i < start.mass.size(); ++i)
    if (problem.world.comes_later(i)) start.mass[i] = 0;
  const double before = kinetic_energy(problem.world, start);
  double potential = 0;
  for (Entity i = 0; i < start.mass.size(); ++i)
    if (!problem.world.comes_later(i))
      potential -= problem.world.mass[i] * problem.world.gravity.dot(start.position[i]);
  return energy(problem, run.end) - before - potential - run.tally.work + run.tally.energy_lost +
         run.tally.changes.removed.energy - run.tally.changes.appeared.energy;
}

TEST(Appearances, ABodyMovesFromThenOnAsFromTheStart) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 5, 0}, {1, 2, 0}, 2);
  problem.ball({8, 5, 0}, {0, 0, 0}, 1);
  problem.plane({0, 0, 0}, {0, 1, 0});
  appear(problem, 0, 0.75);
  problem.options.duration = 1.5;
  Outcome run;
  EXPECT_EQ(appearances(problem, &run)[0], 0.75);
  EXPECT_LT((run.end.position[0] - Vec3(0.75, 5 + 2 * 0.75 - 5 * 0.75 * 0.75, 0)).norm(), 1e-14);

  // Its energy is booked as it comes.
  EXPECT_EQ(run.tally.changes.appeared.bodies, 1u);
  EXPECT_DOUBLE_EQ(run.tally.changes.appeared.energy, 0.5 * 2 * 5 + 2 * 10 * 5);
  EXPECT_EQ(run.tally.changes.appeared.momentum, Vec3(2, 4, 0));
  EXPECT_LT(std::abs(unaccounted(problem, run)), 1e-12);
}

TEST(Appearances, BeforeItABodyIsNoObstacleAndOutOfTheState) {
  Problem problem;
  problem.ball({0, 0, 0}, Vec3::Zero());
  problem.ball({-3, 0, 0}, {2, 0, 0});
  appear(problem, 0, 4);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  simulator->advance_to(3.5);
  EXPECT_EQ(simulator->tally().collisions(), 0u);
  EXPECT_EQ(simulator->state().part_of[0], no_entity);
  EXPECT_EQ(simulator->state().mass[0], 0);
  simulator->advance_to(5);
  EXPECT_EQ(simulator->state().part_of[0], 0u);
  EXPECT_EQ(simulator->state().mass[0], 1);
}

TEST(Appearances, ABodyWaitsUntilTheLastThingHasLeftItsPlace) {
  // Two balls pass the place. The second is in it when the first has left.
  Problem problem;
  problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.5);
  problem.ball({-2, 0.6, 0}, {1, 0, 0}, 1, 0.5);
  problem.ball({-2.5, -0.6, 0}, {1, 0, 0}, 1, 0.5);
  appear(problem, 0, 2);
  problem.options.duration = 6;
  EXPECT_NEAR(appearances(problem)[0], 3.3, 1e-11);

  // Under gravity: y = 3 - 5 t^2 is 1 below the place at t = 1.
  Problem falling;
  falling.world.gravity = Vec3(0, -10, 0);
  falling.ball({0, -1, 0}, Vec3::Zero(), 1, 0.5);
  falling.ball({0, 3, 0}, Vec3::Zero(), 1, 0.5);
  appear(falling, 0, 0.9);
  falling.options.duration = 2;
  EXPECT_NEAR(appearances(falling)[0], 1, 1e-11);
}

TEST(Appearances, ABlockerThatIsStruckLeavesAtItsNewTime) {
  // It lies in the place until a ball of equal mass takes its turn: from t = 2 on it moves at 1 m/s.
  Problem problem;
  problem.ball({0.25, 0, 0}, Vec3::Zero(), 1, 0.5);
  problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.5);
  problem.ball({-3, 0, 0}, {1, 0, 0}, 1, 0.5);
  appear(problem, 0, 1);
  EXPECT_NEAR(appearances(problem)[0], 2 + 1.25, 1e-11);

  // Never, if nothing comes.
  problem.initial.velocity[2] = Vec3::Zero();
  Outcome run;
  EXPECT_TRUE(std::isnan(appearances(problem, &run)[0]));
  EXPECT_EQ(run.tally.changes.appeared.bodies, 0u);
}

TEST(Appearances, AMovingThingLeavesThePlace) {
  Problem problem;
  problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.5);
  problem.obstacle({0, 0.2, 0}, Volume::sphere(0.5));
  problem.move(1, {{0.5, 3, Vec3(0, 2, 0)}});
  appear(problem, 0, 0.25);
  EXPECT_NEAR(appearances(problem)[0], 0.9, 1e-11);
}

TEST(Appearances, BodiesRestWhereTheyAppearOnFloorsAndOnOneAnother) {
  // A stack that comes from the bottom up, and the same with all from the start.
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  for (int i = 0; i < 4; ++i)
    problem.body(Volume::box({0.4, 0.2, 0.4}), {0.02 * i, 0.1 + 0.2 * i, 0}, Vec3::Zero(), 1, 0);

  problem.plane({0, 0, 0}, {0, 1, 0});
  for (Entity i = 1; i < 4; ++i) appear(problem, i, 0.5 * i);
  problem.options.duration = 3;
  Outcome run;
  const vector<double> times = appearances(problem, &run);
  for (Entity i = 0; i < 4; ++i) {
    EXPECT_TRUE(i == 0 || times[i] == 0.5 * i) << i;
    EXPECT_LT((run.end.position[i] - problem.initial.position[i]).norm(), 1e-12) << i;
    EXPECT_LT(run.end.velocity[i].norm(), 1e-12) << i;
  }
  EXPECT_EQ(run.tally.resting, 4u);
  EXPECT_LT(std::abs(unaccounted(problem, run)), 1e-12);
}

/// Balls that pour into a bin.
Problem poured(Entity count, double rate, double height) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  for (Entity i = 0; i < count; ++i) problem.ball({0, height, 0}, Vec3::Zero(), 1, 0.1, 0.3);
  for (Entity i = 0; i < count; ++i) appear(problem, i, i / rate);
  problem.world.pours = {{0, count, rate, {0, height, 0}, {Shape::box, {0.4, 0.2, 0.4}}, 5}};
  problem.room({-0.5, 0, -0.5}, {0.5, 9, 0.5});
  problem.options.duration = 3;
  return problem;
}

TEST(Appearances, BallsPourOneAfterTheOtherWithoutOverlap) {
  const Problem problem = poured(100, 50, 2);
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  for (int k = 0; k <= 60; ++k) {
    const double t = k / 20.0;
    while (simulator->time() < t) simulator->advance_to(t);
    const State& state = simulator->state();

    for (Entity i = 0; i < 100; ++i) {
      EXPECT_TRUE(state.part_of[i] != i || i / 50.0 <= t + 1e-9) << i << " at " << t;
      for (Entity j = 0; j < i; ++j) {
        const bool both = state.part_of[i] == i && state.part_of[j] == j;
        EXPECT_TRUE(!both || (state.position[i] - state.position[j]).norm() > 0.2 - 1e-9) << i << " and " << j;
      }
    }
  }
  Outcome run{{}, {}, simulator->state(), simulator->tally()};
  EXPECT_EQ(run.tally.changes.appeared.bodies, 100u);
  EXPECT_LT(std::abs(unaccounted(problem, run) + run.tally.method_error), 1e-9);
}

TEST(Appearances, BallsOfAPourWaitInTurnWhereThereIsNoRoom) {
  // The place holds one ball at a time, and a ball takes sqrt(2 * 0.2 / 10) = 0.2 s to fall out of it.
  Problem problem = poured(8, 50, 6);
  problem.world.pours[0].within = {Shape::box, {0.1, 0.1, 0.1}};
  problem.options.duration = 2;
  const vector<double> times = appearances(problem);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(times[size_t(i)], 0.2 * i, 0.0201) << i;
  EXPECT_TRUE(ranges::is_sorted(times));
}

TEST(Appearances, OrderOfBodiesAndWhatStandsFarAwayChangeNothing) {
  const auto run = [](bool reversed, bool far) {
    Problem problem;
    problem.world.gravity = Vec3(0, -10, 0);
    for (int k = 0; k < 3; ++k) {
      const int i = reversed ? 2 - k : k;
      problem.ball({0.3 * i, 1.0 + i, 0}, {0.5, 0, 0}, 1 + i, 0.2, 0.7);
    }

    if (far) problem.ball({1000, 5, 0}, Vec3::Zero(), 1, 0.2);
    problem.plane({0, 0, 0}, {0, 1, 0});
    for (int k = 0; k < 3; ++k) appear(problem, Entity(reversed ? 2 - k : k), 0.3 * k);
    problem.options.duration = 2;
    vector<Vec3> places = run_exact(problem).end.position;
    if (reversed) std::swap(places[0], places[2]);
    places.resize(3);
    return places;
  };

  const vector<Vec3> places = run(false, false);
  for (const vector<Vec3>& others : {run(true, false), run(false, true)})
    for (size_t i = 0; i < 3; ++i) EXPECT_LT((others[i] - places[i]).norm(), 1e-12);
}

TEST(Appearances, BodiesUnderDragComeInSteps) {
  // The same flight as from the start, later.
  const auto run = [](double at, Integrator integrator) {
    Problem problem;
    problem.world.gravity = Vec3(0, -10, 0);
    problem.world.forces.push_back({Drag{0, 0.3, Vec3(1, 0, 0)}});
    problem.ball({0, 5, 0}, {1, 2, 0}, 1, 0.1);
    problem.ball({5, 5, 0}, {1, 2, 0}, 1, 0.1);
    if (at > 0) appear(problem, 0, at);

    problem.options.integrator = integrator;
    if (integrator != Integrator::dop853) problem.options.step = 0.25;
    problem.options.duration = 1 + at;
    return run_exact(problem).end.position[0];
  };
  for (const Integrator integrator : {Integrator::dop853, Integrator::rk4, Integrator::verlet})
    EXPECT_LT((run(0.5, integrator) - run(0, integrator)).norm(), 1e-11) << int(integrator);
}

TEST(Appearances, ARunThatEndsAtRestWaitsForThem) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.ball({0, 0.5, 0}, Vec3::Zero());
  problem.ball({3, 0.5, 0}, Vec3::Zero());
  problem.plane({0, 0, 0}, {0, 1, 0});
  appear(problem, 1, 2.5);
  problem.options.stop_at_rest = true;
  const Outcome run = run_exact(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->time, 2.5);
}

TEST(Appearances, ASnapshotGoesOnWithTheSameBits) {
  const Problem problem = poured(80, 100, 1);
  for (const double at : {0.1, 0.51, 0.9}) {
    const auto first = make_exact_simulator(problem.world, problem.initial, problem.options);
    while (first->time() < at) first->advance_to(at);
    const auto second = make_exact_simulator(problem.world, problem.initial, problem.options);
    second->restore(first->save());
    for (Simulator* each : {first.get(), second.get()})
      while (each->time() < 1.5) each->advance_to(1.5);
    EXPECT_EQ(first->state().position, second->state().position) << at;
    EXPECT_EQ(first->tally().changes.appeared.energy, second->tally().changes.appeared.energy) << at;
  }
}

}  // namespace
}  // namespace carom
