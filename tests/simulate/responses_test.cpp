// Impacts: e = 0, e > 1, merging bodies.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

TEST(NoRestitution, AlongTheSurfaceABallSlidesOnAsBefore) {
  Problem problem;
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 1.5, 0}, {3, -1, 0.25}, 1, 0.5, 0);
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.collisions[0].time, 1);
  EXPECT_EQ(run.end.velocity[0], Vec3(3, 0, 0.25));
  EXPECT_EQ(run.end.position[0], Vec3(30, 0.5, 2.5));
  EXPECT_EQ(run.tally.energy_lost, 0.5);
}

TEST(NoRestitution, UnderGravityTheFirstImpactIsTheLast) {
  Problem problem;
  problem.world.gravity = Vec3(0, -2, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 1.5, 0}, {3, 0, 0}, 1, 0.5, 0);
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.end.velocity[0], Vec3(3, 0, 0));
  EXPECT_EQ(run.end.position[0], Vec3(30, 0.5, 0));
  EXPECT_EQ(run.tally.resting, 1u);
}

TEST(NoRestitution, AcrossTheLineOfCentresBallsKeepTheirVelocities) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0.5, 0}, 1, 0.5, 0);
  problem.ball({3, 0, 0}, {-3, 0.5, 0}, 3, 0.5, 0);
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.end.velocity[0], Vec3(-2, 0.5, 0));
  EXPECT_EQ(run.end.velocity[1], Vec3(-2, 0.5, 0));
}

Problem between_walls(double e) {
  Problem problem;
  problem.room({0, 0, 0}, {2, 2, 2});
  problem.ball({1, 1, 1}, {1, 0, 0}, 2, 0.5, e);
  problem.options.duration = 100;
  return problem;
}

TEST(RestitutionAboveOne, EveryImpactMakesEnergy) {
  Problem problem = between_walls(1.25);
  problem.options.duration = 3.5;  // impacts at 0.5, 0.5 + 1/1.25, + 1/1.25^2, ...
  const Outcome run = run_exact(problem);

  double time = 0.5, v = 1;
  for (const Collision& c : run.collisions) {
    EXPECT_NEAR(c.time, time, 1e-15);
    EXPECT_NEAR(c.energy_lost, -(1.25 * 1.25 - 1) * v * v, 1e-15 * v * v);
    v *= 1.25;
    time += 1 / v;
  }

  EXPECT_EQ(run.collisions.size(), 7u);
  EXPECT_NEAR(-run.tally.energy_lost, v * v - 1, 1e-14 * v * v);
}

// Each crossing is shorter than the one before: infinitely many come before t = 0.5 + 1/(e - 1).
TEST(RestitutionAboveOne, SpeedsWithoutBoundEndTheRunWithWhatToDo) {
  for (double e : {2.0, 1.5, 1.1, 1.01, 1.001}) {
    Problem problem = between_walls(e);
    problem.options.duration = 2000;
    const string error = error_of(problem);
    EXPECT_NE(error.find("adds energy"), string::npos) << e << ": " << error;
    EXPECT_NE(error.find("lower"), string::npos) << e << ": " << error;
  }
}

// If one side takes energy and the other adds more, bounces too fast for the clock are not a collapse.
TEST(RestitutionAboveOne, OnOneSideAloneEndsTheRunToo) {
  Problem problem = between_walls(2);
  problem.world.pairs = {{0, 1, 1, 1, 0.9}, {0, 1, 2, 1, 2}};
  problem.options.duration = 2000;
  const string error = error_of(problem);
  EXPECT_NE(error.find("adds energy"), string::npos) << error;
}

/// m^3, of a body that may have merged.
double volume_of(const State& state, size_t i) {
  return (state.volume.empty() ? Volume::sphere(state.radius[i]) : state.volume[i]).size();
}

TEST(Merge, JointBodiesKeepMassMomentumCentreAndVolume) {
  Problem problem;
  problem.options.merge = true;
  problem.ball({0, 0, 0}, {2, 0, 0}, 3, 0.5);
  problem.ball({3, 0.25, 0}, {-1, 0.5, 0}, 1, 0.25);

  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.tally.merges, 1u);
  const State& s = run.end;

  EXPECT_EQ(s.part_of, (vector<Entity>{0, 0}));
  EXPECT_EQ(s.mass[0], 4);
  EXPECT_EQ(s.mass[1], 0);

  EXPECT_LT((s.velocity[0] - Vec3(1.25, 0.125, 0)).norm(), 1e-15);
  EXPECT_LT((s.position[0] - (Vec3(0.75, 0.0625, 0) + 10 * Vec3(1.25, 0.125, 0))).norm(), 1e-14);
  EXPECT_NEAR(volume_of(s, 0), 4.0 / 3 * M_PI * (0.125 + 0.015625), 1e-15);
  EXPECT_NEAR(run.tally.energy_lost, 0.5 * 0.75 * (9 + 0.25), 1e-14);
}

// The first ball lies near the top of a globe, and slides down when the other one falls on it.
TEST(Merge, ABallOnACurvedSurfaceMergesWithOneThatFallsOnIt) {
  for (const double heavier : {0.5, 2.0}) {
    Problem problem;
    problem.world.gravity = Vec3(0, -10, 0);
    problem.options.merge = true;
    problem.options.duration = 3;

    problem.obstacle(Vec3::Zero(), Volume::sphere(1));
    problem.ball({0.05, 1.21, 0}, Vec3::Zero(), 1, 0.2, 0);
    problem.ball({0.05, 3, 0}, Vec3::Zero(), heavier, 0.2, 0);
    const double before = potential_energy(problem.world, problem.initial);

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.tally.merges, 1u);
    const size_t whole = heavier > 1 ? 1 : 0;
    EXPECT_EQ(run.end.mass[whole], 1 + heavier);
    EXPECT_LT(run.end.position[whole].y(), -10);  // off the globe

    const double after = 0.5 * run.end.mass[whole] * run.end.velocity[whole].squaredNorm() +
                         10 * run.end.mass[whole] * run.end.position[whole].y();
    EXPECT_NEAR(after, before + run.tally.work - run.tally.energy_lost - run.tally.method_error, 1e-11 * before);
  }
}

TEST(Merge, ARowBecomesOneLump) {
  Problem problem;
  problem.options.merge = true;
  problem.options.duration = 1000;
  for (int i = 0; i < 20; ++i) problem.ball({2.0 * i, 0, 0}, {i == 0 ? 1.0 : 0.0, 0, 0}, 1 + i % 3, 0.5);

  const Outcome run = run_exact(problem);
  const double mass = 39;  // 1 + 2 + 3 + 1 + ... + 2
  EXPECT_EQ(run.tally.merges, 19u);
  for (size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(run.end.velocity[i].x(), 1 / mass, 1e-16);
    EXPECT_EQ(run.end.part_of[i], run.end.part_of[0]);
  }

  double volume = 0, m = 0;
  for (size_t i = 0; i < 20; ++i)
    if (run.end.mass[i] > 0) {
      volume += volume_of(run.end, i);
      m += run.end.mass[i];
    }

  EXPECT_EQ(m, mass);
  EXPECT_NEAR(volume, 20 * 4.0 / 3 * M_PI * 0.125, 1e-13);
}

TEST(Merge, ACloudThatFallsTogetherKeepsItsSums) {
  Problem problem;
  problem.options.merge = true;
  problem.options.duration = 30;

  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x(i % 5 - 2 + random(-0.2, 0.2), i / 5 % 5 - 2 + random(-0.2, 0.2), i / 25 - 1.5 + random(-0.2, 0.2));
    const Vec3 v = -0.1 * x + 0.02 * Vec3(random(-1, 1), random(-1, 1), random(-1, 1));
    problem.ball(x, v, random(1, 2), random(0.1, 0.25));
  }

  Vec3 p = Vec3::Zero(), center = Vec3::Zero();
  double mass = 0, volume = 0;
  for (size_t i = 0; i < 100; ++i) {
    mass += problem.world.mass[i];
    p += problem.world.mass[i] * problem.initial.velocity[i];
    center += problem.world.mass[i] * problem.initial.position[i];
    volume += Volume::sphere(problem.world.radius[i]).size();
  }

  const Outcome run = run_exact(problem);
  double end_mass = 0, end_volume = 0, kinetic = 0;
  Vec3 end_p = Vec3::Zero(), end_center = Vec3::Zero();
  for (size_t i = 0; i < 100; ++i) {
    if (run.end.mass[i] == 0) continue;
    end_mass += run.end.mass[i];
    end_p += run.end.mass[i] * run.end.velocity[i];
    end_center += run.end.mass[i] * run.end.position[i];
    end_volume += volume_of(run.end, i);
    kinetic += 0.5 * run.end.mass[i] * run.end.velocity[i].squaredNorm();
  }

  EXPECT_GT(run.tally.merges, 50u);
  // Measured: mass 2.2e-16, momentum 3.1e-15, centre 1.4e-13, volume 3.3e-15, energy 4.4e-16.
  EXPECT_NEAR(end_mass / mass, 1, 1e-15);
  EXPECT_LT((end_p - p).norm(), 1e-14);
  EXPECT_LT((end_center - center - 30 * p).norm(), 1e-12);
  EXPECT_NEAR(end_volume / volume, 1, 1e-14);
  EXPECT_NEAR(kinetic_energy(problem.world, problem.initial) - run.tally.energy_lost, kinetic, 4e-15);
}

}  // namespace
}  // namespace carom
