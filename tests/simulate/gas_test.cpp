// Many balls in a room: invariants without reference values.
#include <gtest/gtest.h>

#include <cstring>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// side^3 balls on a lattice in a room, at the given number of balls per cubed diameter.
Problem gas(int side, double density, double e = 1, bool mixed = false) {
  Problem problem;
  Random random;
  const double spacing = std::cbrt(1 / density);

  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        const Vec3 v(random(-1, 1), random(-1, 1), random(-1, 1));
        const double radius = mixed ? random(0.05, 0.5) : 0.5;
        problem.ball(Vec3(i + 0.5, j + 0.5, k + 0.5) * spacing, v, mixed ? 8 * radius * radius * radius : 1, radius, e);
      }

  problem.room({0, 0, 0}, Vec3::Constant(side * spacing));
  return problem;
}

bool same_bits(const vector<Vec3>& a, const vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

bool same_bits(const Outcome& a, const Outcome& b) {
  return same_bits(a.end.position, b.end.position) && same_bits(a.end.velocity, b.end.velocity) &&
         a.tally.collisions() == b.tally.collisions();
}

/// The deepest overlap of any pair or surface of a room, over all of them. Negative: none.
double deepest_overlap(const World& world, const State& state) {
  double deepest = -infinity;
  for (Entity i = 0; i < world.body_count(); ++i) {
    for (Entity j = 0; j < i; ++j)
      deepest = std::max(deepest, world.radius[i] + world.radius[j] - (state.position[i] - state.position[j]).norm());
    for (const Plane& plane : world.planes)
      deepest = std::max(deepest, world.radius[i] - (state.position[i] - plane.point).dot(plane.normal));
  }
  return deepest;
}

TEST(Gas, EnergyStaysAndNothingOverlapsOverManyCollisions) {
  Problem problem = gas(10, 0.5);
  problem.options.duration = 20;
  const Outcome run = run_exact(problem);
  EXPECT_GT(run.tally.collisions(), 50000u);
  const double start = energy(problem, problem.initial);
  EXPECT_NEAR(energy(problem, run.end) / start, 1, 1e-13);  // measured: 9e-15; 2e-13 after 1e6 collisions
  EXPECT_LT(run.tally.max_overlap, 1e-13);
  EXPECT_LT(deepest_overlap(problem.world, run.end), 1e-13);
}

TEST(Gas, NoContactIsMissed) {
  SLOW_WITH_SANITIZERS();
  for (bool mixed : {false, true}) {
    Problem problem = gas(5, 0.4, 0.9, mixed);
    problem.world.gravity = Vec3(0, -0.5, 0.1);
    problem.options.duration = 5;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (int i = 1; i <= 5000; ++i) {
      const double t = i * 1e-3;
      while (simulator->time() < t) simulator->advance_to(t);
      ASSERT_LT(deepest_overlap(problem.world, simulator->state()), 1e-12) << "t = " << t;
    }
  }
}

TEST(Gas, EnergyBooksBalanceForEveryRestitution) {
  for (double e : {0.0, 0.3, 0.9, 1.0, 1.02}) {
    Problem problem = gas(5, 0.3, e, true);
    problem.world.gravity = Vec3(0.1, -1, 0);
    problem.options.duration = 3;
    const Outcome run = run_exact(problem);
    const double start = energy(problem, problem.initial), end = energy(problem, run.end);
    EXPECT_NEAR(end - start + run.tally.energy_lost, 0, 1e-12 * std::abs(start)) << "e = " << e;
    if (e != 1) {
      EXPECT_EQ(run.tally.energy_lost > 0, e < 1);
    }
  }
}

TEST(Gas, MoreStatesReadMoveNothing) {
  Problem problem = gas(5, 0.3, 0.9, true);
  problem.world.gravity = Vec3(0, -1, 0);

  const Outcome once = run_exact(problem);
  // Read again and again.
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  size_t collisions = 0;
  for (int i = 1; i <= 3333; ++i) do {
      simulator->advance_to(i * problem.options.duration / 3333);
      collisions +=
          static_cast<size_t>(std::count_if(simulator->collisions().begin(), simulator->collisions().end(),
                                            [](const Collision& c) { return c.kind != CollisionKind::rest; }));
      simulator->state();
    } while (simulator->time() < i * problem.options.duration / 3333);

  EXPECT_TRUE(same_bits(once.end.position, simulator->state().position));
  EXPECT_TRUE(same_bits(once.end.velocity, simulator->state().velocity));
  EXPECT_EQ(collisions, once.collisions.size());
}

TEST(Gas, NotRecordingChangesNothing) {
  Problem problem = gas(4, 0.3);
  const Outcome recorded = run_exact(problem);
  EXPECT_EQ(recorded.collisions.size(), recorded.tally.collisions());
  problem.options.record_collisions = false;
  const Outcome silent = run_exact(problem);
  EXPECT_TRUE(silent.all.empty());
  EXPECT_TRUE(same_bits(recorded, silent));
}

// Lengths by 2^3, times by 2^-2, masses by 2^5: the same bits after scaling back. An absolute epsilon anywhere fails
// this.
TEST(Gas, ScalingByPowersOfTwoGivesTheSameBits) {
  for (double e : {1.0, 0.5}) {
    Problem problem = gas(4, 0.3, e, true);
    problem.world.gravity = Vec3(0, -1, 0.25);
    problem.options.duration = e < 1 ? 2.5 : 8;

    // In other units.
    Problem scaled = problem;
    const double length = 8, time = 0.25, mass = 32;
    for (double& m : scaled.world.mass) m *= mass;
    for (double& r : scaled.world.radius) r *= length;
    for (Plane& p : scaled.world.planes) p.point *= length;
    scaled.world.gravity *= length / (time * time);
    for (Vec3& x : scaled.initial.position) x *= length;
    for (Vec3& v : scaled.initial.velocity) v *= length / time;
    scaled.options.duration *= time;

    const Outcome a = run_exact(problem);
    Outcome b = run_exact(scaled);
    for (Vec3& x : b.end.position) x /= length;
    for (Vec3& v : b.end.velocity) v /= length / time;

    EXPECT_TRUE(same_bits(a, b)) << "e = " << e;
  }
}

TEST(Gas, ReversedVelocitiesLeadBackToTheStart) {
  Problem problem = gas(5, 0.3);

  problem.options.duration = 4;  // 8 collisions a ball
  const Outcome there = run_exact(problem);
  EXPECT_GT(there.tally.body_body * 2, 8u * 125);

  Problem back = problem;
  back.initial = there.end;
  for (Vec3& v : back.initial.velocity) v = -v;
  const Outcome home = run_exact(back);

  double worst = 0;
  for (Entity i = 0; i < problem.world.body_count(); ++i)
    worst = std::max(worst, (home.end.position[i] - problem.initial.position[i]).norm());
  EXPECT_LT(worst, 1e-9);  // measured: 2e-11
}

TEST(Gas, WithoutWallsACommonVelocityChangesOnlyTheFrame) {
  Problem problem = gas(4, 0.3, 0.9);
  problem.world.planes.clear();
  problem.options.duration = 2;
  Problem moving = problem;
  const Vec3 common(0.5, -0.25, 2);
  for (Vec3& v : moving.initial.velocity) v += common;
  const Outcome a = run_exact(problem), b = run_exact(moving);
  ASSERT_EQ(a.tally.collisions(), b.tally.collisions());
  for (Entity i = 0; i < problem.world.body_count(); ++i)
    EXPECT_LT((b.end.position[i] - 2 * common - a.end.position[i]).norm(), 1e-10);
  EXPECT_LT((momentum(problem.world, a.end) - momentum(problem.world, problem.initial)).norm(), 1e-13);
}

TEST(Gas, TheOrderOfTheAxesDoesNotMatter) {
  Problem problem = gas(4, 0.3);
  problem.options.duration = 2;
  Problem turned = problem;
  const auto turn = [](Vec3& v) { v = Vec3(v.y(), v.z(), v.x()); };

  for (Vec3& x : turned.initial.position) turn(x);
  for (Vec3& v : turned.initial.velocity) turn(v);
  for (Plane& p : turned.world.planes) turn(p.point), turn(p.normal);

  Outcome a = run_exact(problem), b = run_exact(turned);
  ASSERT_EQ(a.tally.collisions(), b.tally.collisions());
  for (Vec3& x : a.end.position) turn(x);
  for (Entity i = 0; i < problem.world.body_count(); ++i)
    EXPECT_LT((a.end.position[i] - b.end.position[i]).norm(), 1e-10);
}

TEST(Gas, ASceneOfNoneOrOneBallEnds) {
  Problem none;
  EXPECT_EQ(run_exact(none).tally.collisions(), 0u);
  Problem one;
  one.ball({0, 0, 0}, {1e8, 0, 0});
  one.options.duration = 1e3;
  EXPECT_EQ(run_exact(one).end.position[0], Vec3(1e11, 0, 0));
}

TEST(Gas, ALimitOnCollisionsEndsTheRunWithItsReason) {
  Problem problem = gas(4, 0.5);
  problem.options.max_collisions = 100;
  try {
    run_exact(problem);
    FAIL() << "no error";
  } catch (const SimulationError& error) {
    EXPECT_EQ(string(error.what()).rfind("more than simulate.max_collisions = 100 collisions, reached at t = ", 0), 0u);
  }
}

}  // namespace
}  // namespace carom
