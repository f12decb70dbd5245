// Regions that remove the bodies which enter them: books, and what becomes of the others.
#include <gtest/gtest.h>

#include <numbers>

#include "simulate/regions.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

TEST(Removal, BooksTheEnergyAndTheMomentumOfTheBody) {
  Problem problem = gas_among_regions(30);
  problem.world.gravity = Vec3(0.5, -3, 1);
  problem.world.restitution.assign(30, 0.9);
  problem.world.regions = {removing(region_at({1.5, -1.5, 1.5}, Volume::sphere(0.9)))};

  const WithRegions run = run_with(problem);
  ASSERT_GT(run.tally.changes.removed.bodies, 8u);
  ASSERT_LT(run.tally.changes.removed.bodies, 30u);
  EXPECT_EQ(run.crossings.size(), run.tally.changes.removed.bodies);
  EXPECT_LT(std::abs(left(problem, run)), 1e-12);  // measured: 1e-13

  for (const RegionCrossing& crossing : run.crossings) {
    EXPECT_TRUE(crossing.enters);
    EXPECT_EQ(run.end.part_of[crossing.body], no_entity);
    EXPECT_EQ(run.end.mass[crossing.body], 0);
    for (const Collision& collision : run.all) {
      const bool concerned = collision.a == crossing.body || collision.b == crossing.body;
      EXPECT_TRUE(!concerned || collision.time <= crossing.time);
    }
  }

  // The others do not notice where it was.
  EXPECT_LT(run.tally.max_overlap, 1e-12);
}

TEST(Removal, LeavesNoCrossingOfThatInstantOut) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0}, 1, 0.1);

  WorldRegion beyond;
  beyond.position = beyond.normal = Vec3(1, 0, 0);
  WorldRegion before = beyond;
  before.normal *= -1;
  problem.world.regions = {beyond, region_at({2, 0, 0}, Volume::box({2, 2, 2})), removing(beyond), beyond, before};
  problem.options.duration = 2;

  WithRegions run = run_with(problem);
  const vector<RegionCrossing> all = {{0, 4, 0, true}, {1, 0, 0, true}, {1, 1, 0, true},
                                      {1, 2, 0, true}, {1, 3, 0, true}, {1, 4, 0, false}};
  EXPECT_EQ(run.crossings, all);
  EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
  EXPECT_FALSE(run.tally.end);

  // One of them ends the run.
  problem.world.regions[3] = stopping(beyond);
  run = run_with(problem);
  EXPECT_EQ(run.crossings, all);
  EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->region, 3u);
}

TEST(Removal, KeepsTheMomentumOfAFreeGas) {
  Problem problem = gas_among_regions(20);
  problem.world.planes.clear();
  for (Entity i = 0; i < 20; ++i) problem.initial.velocity[i] -= problem.initial.position[i];
  problem.world.regions = {removing(region_at({0, 0, 0}, Volume::sphere(1.4)))};
  const WithRegions run = run_with(problem);
  ASSERT_GT(run.tally.changes.removed.bodies, 3u);
  const Vec3 drift =
      momentum(problem.world, run.end) + run.tally.changes.removed.momentum - momentum(problem.world, problem.initial);
  EXPECT_LT(drift.norm(), 1e-13);
}

TEST(Removal, OfTheLowestBallLetsThePileFall) {
  // Three balls on each other, the lowest one in the region.
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  for (int k = 0; k < 3; ++k) problem.ball({0, 0.5 + k, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.world.regions = {removing(region_at({0, 0.5, 0}, Volume::box({0.2, 0.2, 0.2})))};
  problem.options.duration = 2;
  const WithRegions run = run_with(problem);
  // The lowest is inside at time 0. The next one falls by 1 - 0.1 m to the region's top, and so does the last one.
  ASSERT_EQ(run.crossings.size(), 3u);
  EXPECT_EQ(run.crossings[0], (RegionCrossing{0, 0, 0, true}));
  EXPECT_NEAR(run.crossings[1].time, sqrt(0.9 * 2 / 10), 1e-13);
  // 0.1 m above the ball that it rested on, it falls as that one did.
  EXPECT_NEAR(run.crossings[2].time, sqrt(1.9 * 2 / 10), 1e-13);
  EXPECT_EQ(run.tally.changes.removed.bodies, 3u);
  EXPECT_LT(std::abs(left(problem, run)), 1e-12);
  EXPECT_EQ(run.tally.resting, 0u);
}

TEST(Removal, OfASleepersSupportWakesTheSleeper) {
  // A ball rests on two others between walls. One of these is in the region. A fourth ball falls on them later.
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);

  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.wall({-1.01, 1, 0}, {1, 0, 0}, 4, 4);
  problem.wall({1.01, 1, 0}, {-1, 0, 0}, 4, 4);
  problem.ball({-0.51, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.ball({0.51, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0);

  const double height = 0.5 + sqrt(1 - 0.51 * 0.51);
  problem.ball({0, height, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.ball({0, 30, 0}, {0, 0, 0}, 1, 0.5, 0);

  problem.world.regions = {removing(region_at({0.51, 0.5, 0}, Volume::sphere(0.1)))};
  problem.world.regions[0].on = {1};
  problem.options.duration = 2;

  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
  EXPECT_LT(run.end.position[2].y(), 0.6);  // it lies on the floor
  EXPECT_LT(std::abs(left(problem, run)), 1e-11);
}

TEST(Removal, OfAJointBodyTakesAllItsParts) {
  Problem problem;
  problem.options.merge = true;
  problem.ball({-2, 0, 0}, {1, 0, 0}, 1);
  problem.ball({0, 0, 0}, {0, 0, 0}, 1);
  problem.world.regions = {removing(side_at({1, 0, 0}, {1, 0, 0}))};
  problem.options.duration = 6;
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 1u);
  // They meet at t = 1, at x = -0.5, and go on at half the speed.
  EXPECT_NEAR(run.crossings[0].time, 4, 1e-14);
  EXPECT_EQ(run.end.part_of, (vector<Entity>{no_entity, no_entity}));
  EXPECT_NEAR(run.tally.changes.removed.energy, 0.25, 1e-15);
  EXPECT_EQ(kinetic_energy(problem.world, run.end), 0);
}

TEST(Removal, OnABentPathBooksTheEnergyThere) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 0.8, 0}, 2, 0.01);
  problem.world.forces.push_back({Attractor{Vec3::Zero(), 1, 0}});
  problem.world.regions = {removing(side_at({0, 0, 0}, {-1, 0, 0}))};
  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.changes.removed.bodies, 1u);
  EXPECT_NEAR(run.tally.changes.removed.energy, 2 * (0.32 - 1), 1e-13);
  EXPECT_LT(std::abs(left(problem, run)), 1e-13);
}

TEST(Removal, OfASleeperInMidRunLetsTheOthersFall) {
  // Three balls sleep on each other. A fourth strikes the lowest along the floor at t = 1, and drives it into the
  // region.
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  for (int k = 0; k < 3; ++k) problem.ball({0, 0.5 + k, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.ball({-3, 0.5, 0}, {2, 0, 0}, 1, 0.5, 0);
  problem.world.regions = {removing(side_at({0.25, 0, 0}, {1, 0, 0}))};
  problem.options.duration = 1.5;

  const WithRegions run = run_with(problem);
  ASSERT_GE(run.crossings.size(), 1u);
  EXPECT_EQ(run.crossings[0].body, 0u);
  EXPECT_GT(run.crossings[0].time, 1);

  EXPECT_LT(std::abs(unbooked(problem, run) + run.tally.changes.removed.energy), 1e-11);  // measured: 2e-12
  EXPECT_LT(run.end.position[2].y(), 2.4);
  EXPECT_LT(run.tally.max_overlap, 1e-11);
}

TEST(Removal, InAPileKeepsTheBooks) {
  // Balls fall into a box with a drain in its floor, and jam above it.
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.room({-1.3, 0, -1.3}, {1.3, 30, 1.3});
  Random random;

  for (int k = 0; k < 60; ++k)
    problem.ball({-0.8 + 0.8 * (k % 3), 0.5 + 0.8 * (k / 9), -0.8 + 0.8 * (k / 3 % 3)}, in_cube(random, 0.1), 1, 0.3,
                 0.4);

  problem.world.regions = {removing(region_at({0.2, 0.3, 0.1}, Volume::cylinder(0.35, 0.1)))};
  problem.options.duration = 6;
  problem.options.stop_at_rest = true;

  const WithRegions run = run_with(problem);
  EXPECT_GT(run.tally.changes.removed.bodies, 4u);
  EXPECT_LT(std::abs(unbooked(problem, run) + run.tally.changes.removed.energy), 1e-9);
  EXPECT_LT(run.tally.max_overlap, 1e-11);
  EXPECT_LE(run.tally.resting, 60 - run.tally.changes.removed.bodies);
}

TEST(Removal, ThroughAHoleIsTheEffusionOfAnIdealGas) {
  SLOW_WITH_SANITIZERS();
  // 20000 points in a cube of edge 2, with velocities of standard deviation 1 in each direction: A v / (4 V) of them
  // hit an area A of a wall in a second. In so short a time none comes to it twice.
  Problem problem;
  problem.room({-1, -1, -1}, {1, 1, 1});
  Random random;
  const auto normal = [&] { return sqrt(-2 * log(random(1e-12, 1))) * std::cos(2 * std::numbers::pi * random(0, 1)); };

  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const Vec3 x = in_cube(random, 0.999);
    const double vx = normal(), vy = normal(), vz = normal();
    problem.ball(x, {vx, vy, vz}, 1, 1e-6);
  }

  problem.world.regions = {removing(region_at({1, 0, 0}, Volume::box({2e-5, 0.8, 0.8})))};
  problem.options.duration = 0.2;
  const WithRegions run = run_with(problem);

  const double mean = sqrt(8 / std::numbers::pi), expected = n * mean * 0.64 / (4 * 8) * 0.2;
  EXPECT_NEAR(static_cast<double>(run.tally.changes.removed.bodies), expected, 4 * sqrt(expected));  // 128 +- 45
}

}  // namespace
}  // namespace carom
