// Forces that set in and cease, impulses, and bodies under unequal accelerations.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

constexpr double for_ever = infinity;

/// A path of parabolas.
struct Path {
  double x, v;
  void go(double a, double t) {
    x += v * t + 0.5 * a * t * t;
    v += a * t;
  }
};

TEST(TimedForces, ThePathIsMadeOfParabolas) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.80665, 0);
  problem.ball({0, 0, 0}, {1, 2, 3}, 2);
  problem.ball({50, 0, 0}, {0, 0, 0}, 3);

  problem.world.forces.push_back({UniformForce{Vec3(4, 0, 0)}, 0.3, 1.7, {0}});
  problem.world.forces.push_back({UniformForce{Vec3(0, 1, 0)}, 1.1, 2.9, {}});
  problem.world.forces.push_back({UniformAcceleration{Vec3(0, 0, -0.7)}, 2.3, for_ever, {0}});
  problem.options.duration = 5;

  const Outcome run = run_exact(problem);
  // By the sums of 2, 4 and 3 parabolas.
  Path x{0, 1}, y{0, 2}, z{0, 3}, other{0, 0};
  x.go(0, 0.3), x.go(2, 1.4), x.go(0, 3.3);
  y.go(-9.80665, 1.1), y.go(-9.80665 + 0.5, 1.8), y.go(-9.80665, 2.1);
  z.go(0, 2.3), z.go(-0.7, 2.7);
  other.go(-9.80665, 1.1), other.go(-9.80665 + 1.0 / 3, 1.8), other.go(-9.80665, 2.1);

  const Vec3 expected_x(x.x, y.x, z.x), expected_v(x.v, y.v, z.v);
  EXPECT_LT((run.end.position[0] - expected_x).norm(), 1e-15 * expected_x.norm());  // measured: 1.3e-16
  EXPECT_LT((run.end.velocity[0] - expected_v).norm(), 1e-15 * expected_v.norm());  // measured: 1.6e-16
  EXPECT_NEAR(run.end.position[1].y(), other.x, 1e-14 * std::abs(other.x));

  const double gain = kinetic_energy(problem.world, run.end) + potential_energy(problem.world, run.end) -
                      kinetic_energy(problem.world, problem.initial);
  EXPECT_NEAR(run.tally.work, gain, 1e-13 * std::abs(potential_energy(problem.world, run.end)));
}

TEST(TimedForces, AWindowOfNoLengthDoesNothingAndTwoThatMeetAreOne) {
  Problem split;
  split.ball({0, 0, 0}, {0, 0, 0});
  Problem whole = split;
  split.world.forces = {{UniformAcceleration{Vec3(1, 0, 0)}, 1, 2, {}},
                        {UniformAcceleration{Vec3(1, 0, 0)}, 2, 4, {}},
                        {UniformAcceleration{Vec3(9, 0, 0)}, 3, 3, {}}};
  whole.world.forces = {{UniformAcceleration{Vec3(1, 0, 0)}, 1, 4, {}}};
  EXPECT_EQ(run_exact(split).end.position[0], run_exact(whole).end.position[0]);
  EXPECT_EQ(run_exact(split).end.velocity[0], Vec3(3, 0, 0));
}

TEST(TimedForces, BallsUnderUnequalAccelerationsMeetAtTheRootOfTheirGap) {
  // 2 m between surfaces; from 0.5 s on one is driven at 4 m/s^2, the other at 1 m/s^2 the same way: 3 t^2 / 2 = 2.
  Problem problem;

  problem.ball({0, 0, 0}, {0, 0, 0}, 1, 0.5, 1);
  problem.ball({3, 0, 0}, {0, 0, 0}, 1, 0.5, 1);
  problem.world.forces = {{UniformAcceleration{Vec3(4, 0, 0)}, 0.5, for_ever, {0}},
                          {UniformAcceleration{Vec3(1, 0, 0)}, 0.5, for_ever, {1}}};
  problem.options.duration = 2;

  const Outcome run = run_exact(problem);
  const double t = sqrt(4.0 / 3);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 0.5 + t, 4e-16);
  EXPECT_NEAR(run.collisions[0].approach_speed, 3 * t, 1e-15);

  const double since = 1.5 - t;
  EXPECT_NEAR(run.end.velocity[0].x(), t + 4 * since, 2e-15);
  EXPECT_NEAR(run.end.velocity[1].x(), 4 * t + since, 2e-15);
}

TEST(TimedForces, ABallIsLiftedOffTheFloorAndComesBack) {
  // Up at 2 m/s^2 net for 1 s: 1 m high at 2 m/s; 2/8 s to the top, 1.25 m; down again in sqrt(2 * 1.25 / 8) s.
  Problem problem;
  problem.world.gravity = Vec3(0, -8, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {0.5, 0, 0}, 1, 0.5, 0);
  problem.world.forces = {{UniformAcceleration{Vec3(0, 10, 0)}, 1, 2, {0}}};
  problem.options.duration = 10;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 2.25 + sqrt(2 * 1.25 / 8), 1e-15);
  EXPECT_EQ(run.end.velocity[0], Vec3(0.5, 0, 0));
  EXPECT_NEAR(run.end.position[0].x(), 5, 2e-15);
  EXPECT_NEAR(run.tally.work, 10, 1e-14);
}

TEST(TimedForces, AForceTooWeakToLiftChangesWhatTheFloorCarries) {
  Problem problem;
  problem.world.gravity = Vec3(0, -8, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 2, 0.5, 0);
  problem.world.forces = {{UniformForce{Vec3(0, 10, 0)}, 1, 2, {0}}};
  problem.options.duration = 3;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  for (const auto& [time, force] : {pair(0.5, 16.0), pair(1.5, 6.0), pair(2.5, 16.0)}) {
    go_to(*simulator, time);
    EXPECT_EQ(force_between(*simulator, 0, 1), force) << time;
    EXPECT_EQ(simulator->state().velocity[0], Vec3(0, 0, 0));
    EXPECT_EQ(simulator->state().position[0], Vec3(0, 0.5, 0));
  }
}

TEST(Impulse, GivesItsVelocityAtTheStart) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 4);
  problem.world.impulse = {Vec3(0, 2, -4)};
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  EXPECT_EQ(simulator->state().velocity[0], Vec3(1, 0.5, -1));
  go_to(*simulator, 10);
  EXPECT_EQ(simulator->state().position[0], Vec3(10, 5, -10));
}

}  // namespace
}  // namespace carom
