// Regions in runs: crossings along paths of every kind, removal, and ends of runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "physics/attractor.h"
#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

struct WithRegions : Outcome {
  vector<RegionCrossing> crossings;
};

WithRegions run_with(const Problem& problem, double slice = 1e9) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  WithRegions run;
  double time = 0;
  while (simulator->time() < problem.options.duration) {
    time = std::min(std::max(time, simulator->time()) + slice, problem.options.duration);
    simulator->advance_to(time);
    run.crossings.insert(run.crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
    run.all.insert(run.all.end(), simulator->collisions().begin(), simulator->collisions().end());
  }
  run.end = simulator->state();
  run.tally = simulator->tally();
  return run;
}

WorldRegion region_at(const Vec3& position, const Volume& volume) {
  WorldRegion region;
  region.position = position;
  region.volume = volume;
  return region;
}

WorldRegion side_at(const Vec3& point, const Vec3& normal) {
  WorldRegion region;
  region.position = point;
  region.normal = normal.normalized();
  return region;
}

WorldRegion removing(WorldRegion region) {
  region.removes = true;
  return region;
}

WorldRegion stopping(WorldRegion region) {
  region.stops = true;
  return region;
}

/// J, what the balance leaves.
double left(const Problem& problem, const WithRegions& run) {
  return residual(problem, run) + run.tally.removed.energy;
}

TEST(Regions, AreEnteredAndLeftAtTheTimesOfTheClosedForm) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 3;
  problem.ball({0, 0, 0}, {2, 12, 0});
  problem.world.regions = {side_at({0, 5, 0}, {0, 1, 0}), region_at({2, 0, 0}, Volume::box({1, 100, 1}))};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 4u);
  const double root = std::sqrt(144 - 10 * g_n);
  const double up = 10 / (12 + root), down = (12 + root) / g_n;
  EXPECT_EQ(run.crossings[0].region, 0u);
  EXPECT_NEAR(run.crossings[0].time, up, 1e-14 * up);
  EXPECT_EQ(run.crossings[1].time, 0.75);
  EXPECT_EQ(run.crossings[2].time, 1.25);
  EXPECT_FALSE(run.crossings[3].enters);
  EXPECT_NEAR(run.crossings[3].time, down, 1e-14 * down);
}

TEST(Regions, SeeABallThatBouncesInside) {
  // Dropped from 1 m above the floor of contact, e = 1: half way down and up again, without end.
  Problem problem;
  problem.world.gravity = Vec3(0, -2, 0);
  problem.options.duration = 9.5;
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 1.5, 0}, {0, 0, 0});
  problem.world.regions = {side_at({0, 0.75, 0}, {0, -1, 0}), side_at({0, 0.5, 0}, {0, -1, 0})};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 10u);
  const double fall = std::sqrt(0.75);
  for (size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(run.crossings[k].region, 0u) << "at its lowest point it touches the other one";
    EXPECT_EQ(run.crossings[k].enters, k % 2 == 0);
    const double bounce = 1 + 2 * std::floor(static_cast<double>(k) / 2);
    const double expected = k % 2 == 0 ? bounce - 1 + fall : bounce + 1 - fall;
    EXPECT_NEAR(run.crossings[k].time, expected, 1e-14 * expected);
  }
}

TEST(Regions, EnteredAtTheInstantOfAnImpactAreEnteredOnce) {
  // A ball that is at rest on the boundary is knocked in at t = 1.
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.world.regions = {side_at({0, 0, 0}, {1, 0, 0}), side_at({-1, 0, 0}, {1, 0, 0})};
  problem.world.regions[1].on = {0};
  const WithRegions run = run_with(problem);
  // The striking ball stops on the boundary of its own region, and does not enter.
  ASSERT_EQ(run.crossings.size(), 1u);
  EXPECT_EQ(run.crossings[0], (RegionCrossing{1, 0, 1, true}));
}

TEST(Regions, TheBodiesInsideAtTheStartEnterAtTimeZero) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({5, 0, 0}, {0, 0, 0});
  problem.world.regions = {region_at({0, 0, 0}, Volume::sphere(2)), side_at({5, 0, 0}, {1, 0, 0})};
  const WithRegions run = run_with(problem);
  ASSERT_GE(run.crossings.size(), 2u);
  EXPECT_EQ(run.crossings[0], (RegionCrossing{0, 0, 0, true}));
  EXPECT_EQ(run.crossings[1], (RegionCrossing{2, 0, 0, false}));
}

TEST(Regions, AreLeftOnAKeplerOrbitAtTheTimesOfKeplersEquation) {
  // Semi-major axis 1, eccentricity 0.6, from the pericentre. Beyond x = 0 the eccentric anomaly has cos E = e.
  Problem problem;
  const double e = 0.6, pi = std::numbers::pi;
  problem.ball({1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}, 1, 0.01);
  problem.world.forces.push_back({Attractor{Vec3::Zero(), 1, 0}});
  problem.world.regions = {side_at({0, 0, 0}, {-1, 0, 0}), region_at({0, 0, 0}, Volume::sphere(1))};
  problem.options.duration = 4 * pi;
  const WithRegions run = run_with(problem);
  // r = 1 - e cos E is 1 at E = pi/2.
  const double half = std::acos(e) - e * std::sin(std::acos(e)), middle = pi / 2 - e;
  std::map<uint32_t, vector<double>> times;
  for (const RegionCrossing& crossing : run.crossings) times[crossing.region].push_back(crossing.time);
  ASSERT_EQ(times[0].size(), 4u);
  ASSERT_EQ(times[1].size(), 5u);
  const double of_side[] = {half, 2 * pi - half, 2 * pi + half, 4 * pi - half};
  for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(times[0][k], of_side[k], 2e-14);  // measured: 4e-15
  const double of_ball[] = {0, middle, 2 * pi - middle, 2 * pi + middle, 4 * pi - middle};
  for (size_t k = 0; k < 5; ++k) EXPECT_NEAR(times[1][k], of_ball[k], 2e-14);  // measured: 4e-15
}

TEST(Regions, OfTheRadiusOfAnOrbitAreNeitherEnteredNorLeft) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 1, 0}, 1, 0.01);
  problem.world.forces.push_back({Attractor{Vec3::Zero(), 1, 0}});
  problem.options.duration = 100;
  for (const double off : {-1e-9, 1e-9, 1e-13})
    problem.world.regions.push_back(region_at({0, 0, 0}, Volume::sphere(1 + off)));
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 2u);
  for (const RegionCrossing& crossing : run.crossings) EXPECT_EQ(crossing.time, 0);
}

TEST(Regions, AreCrossedUnderDragAtTheTimesOfTheClosedForm) {
  // x = (1 - exp(-k t)) v / k: at half of the range at t = ln 2 / k.
  Problem problem;
  problem.ball({0, 0, 0}, {8, 0, 0});
  problem.world.forces.push_back({Drag{0.5, 0, Vec3::Zero()}});
  problem.options.duration = 40;
  problem.world.regions = {side_at({8, 0, 0}, {1, 0, 0}), region_at({15, 0, 0}, Volume::sphere(0.5)),
                           side_at({16.5, 0, 0}, {1, 0, 0})};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 3u);
  const double ln2 = std::numbers::ln2;
  EXPECT_NEAR(run.crossings[0].time, 2 * ln2, 1e-14);
  EXPECT_NEAR(run.crossings[1].time, -2 * std::log(1.5 / 16), 1e-14 * 5);
  EXPECT_NEAR(run.crossings[2].time, -2 * std::log(0.5 / 16), 1e-14 * 7);
}

TEST(Regions, AreEnteredByABallThatSlidesOffAGlobe) {
  // From the top with a small angle: theta(t) by energy, g (cos a - cos theta) = R theta'^2 / 2, until cos theta = 2/3
  // cos a. The time from angle a to b is an integral; here by substitution, without its singular start.
  Problem problem;
  problem.world.gravity = Vec3(0, -1, 0);
  problem.options.duration = 5;
  problem.obstacle({0, 0, 0}, Volume::sphere(0.5));
  const double a = 0.3, b = 0.7;
  problem.ball({std::sin(a), std::cos(a), 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.world.regions = {side_at({0, std::cos(b), 0}, {0, -1, 0})};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 1u);
  // With sin(theta / 2) = sin(a / 2) cosh s: dt = ds / cos(theta / 2).
  const double s = std::acosh(std::sin(b / 2) / std::sin(a / 2));
  double time = 0;
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i)
    for (const double node : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
      const double sine = std::sin(a / 2) * std::cosh(s * (i + node) / parts);
      time += 0.5 * s / parts / std::sqrt(1 - sine * sine);
    }
  EXPECT_NEAR(run.crossings[0].time, time, 1e-11);  // measured: 3e-13
}

/// A gas of balls in a box, with regions of every shape.
Problem gas(int count) {
  Problem problem;
  problem.room({-2, -2, -2}, {2, 2, 2});
  Random random;
  for (int i = 0; i < count; ++i)
    problem.ball({-1.5 + (i % 4), -1.5 + (i / 4 % 4), -1.5 + (i / 16 % 4)}, in_cube(random, 2), 1, 0.2);
  problem.world.regions = {region_at({0.3, 0.2, 0.1}, Volume::sphere(0.9)),
                           region_at({0.3, -0.2, 0.1}, Volume::cylinder(0.8, 1.5)),
                           region_at({-0.3, 0.2, 0.4}, Volume::box({1, 2, 1.5})), side_at({0.1, 0, 0}, {1, 2, 3})};
  problem.options.duration = 4;
  return problem;
}

TEST(Regions, CountAsDenseSamplesOfTheFlightsDo) {
  const Problem problem = gas(20);
  const WithRegions run = run_with(problem);
  std::map<std::pair<uint32_t, Entity>, int> count, sampled;
  for (const RegionCrossing& crossing : run.crossings) ++count[{crossing.region, crossing.body}];
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  std::map<std::pair<uint32_t, Entity>, bool> inside;
  for (int i = 0; i <= 40000; ++i) {
    go_to(*simulator, 4e-4 * i / 4);
    const State& state = simulator->state();
    for (uint32_t r = 0; r < problem.world.regions.size(); ++r)
      for (Entity body = 0; body < 20; ++body) {
        bool& now = inside[{r, body}];
        if (now == holds(problem.world.regions[r], state.position[body])) continue;
        now = !now;
        ++sampled[{r, body}];
      }
  }
  int differences = 0;
  for (const auto& [pair, n] : count) differences += std::abs(n - sampled[pair]);
  EXPECT_GT(run.crossings.size(), 80u);
  EXPECT_EQ(differences, 0);
}

TEST(Regions, TakeTurnsInOrderOfTimeAndChangeNothing) {
  const Problem problem = gas(30);
  const WithRegions run = run_with(problem), sliced = run_with(problem, 0.01);
  Problem without = problem;
  without.world.regions.clear();
  const WithRegions plain = run_with(without);
  EXPECT_EQ(run.crossings, sliced.crossings);
  EXPECT_EQ(run.end.position, plain.end.position);
  EXPECT_EQ(run.end.velocity, plain.end.velocity);
  ASSERT_EQ(run.all.size(), plain.all.size());
  for (size_t k = 0; k < run.all.size(); ++k) EXPECT_EQ(run.all[k].time, plain.all[k].time);
  std::map<std::pair<uint32_t, Entity>, bool> inside;
  for (size_t k = 0; k < run.crossings.size(); ++k) {
    const RegionCrossing& crossing = run.crossings[k];
    bool& now = inside[{crossing.region, crossing.body}];
    EXPECT_NE(now, crossing.enters);
    now = crossing.enters;
    EXPECT_LE(k > 0 ? run.crossings[k - 1].time : 0, crossing.time);
  }
}

TEST(Regions, ScaleByPowersOfTwoAndTurnWithTheAxes) {
  const WithRegions run = run_with(gas(20));
  Problem scaled = gas(20);
  for (Vec3& x : scaled.initial.position) x *= 0x1p20;
  for (Vec3& v : scaled.initial.velocity) v *= 0x1p10;
  for (double& r : scaled.world.radius) r *= 0x1p20;
  for (Plane& plane : scaled.world.planes) plane.point *= 0x1p20;
  for (WorldRegion& region : scaled.world.regions) {
    region.position *= 0x1p20;
    region.volume.half *= 0x1p20;
  }
  scaled.options.duration *= 0x1p10;
  const WithRegions other = run_with(scaled);
  ASSERT_EQ(run.crossings.size(), other.crossings.size());
  for (size_t k = 0; k < run.crossings.size(); ++k) EXPECT_EQ(run.crossings[k].time * 0x1p10, other.crossings[k].time);

  const auto turned = [](const Vec3& v) { return Vec3(v.z(), -v.y(), v.x()); };
  Problem mirrored = gas(20);
  for (Vec3& x : mirrored.initial.position) x = turned(x);
  for (Vec3& v : mirrored.initial.velocity) v = turned(v);
  for (WorldRegion& region : mirrored.world.regions) {
    region.position = turned(region.position);
    region.volume.half = turned(region.volume.half).cwiseAbs();
    region.normal = turned(region.normal);
  }
  mirrored.options.duration = 1;
  const WithRegions mirror = run_with(mirrored);
  ASSERT_GT(mirror.crossings.size(), 15u);
  for (size_t k = 0; k < mirror.crossings.size(); ++k)
    EXPECT_NEAR(run.crossings[k].time, mirror.crossings[k].time, 1e-11);  // rounding, amplified by collisions
}

TEST(Removal, BooksTheEnergyAndTheMomentumOfTheBody) {
  Problem problem = gas(30);
  problem.world.gravity = Vec3(0.5, -3, 1);
  problem.world.restitution.assign(30, 0.9);
  problem.world.regions = {removing(region_at({1.5, -1.5, 1.5}, Volume::sphere(0.9)))};
  const WithRegions run = run_with(problem);
  ASSERT_GT(run.tally.removed.bodies, 8u);
  ASSERT_LT(run.tally.removed.bodies, 30u);
  EXPECT_EQ(run.crossings.size(), run.tally.removed.bodies);
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
  EXPECT_EQ(run.tally.removed.bodies, 1u);
  EXPECT_FALSE(run.tally.end);
  // One of them ends the run.
  problem.world.regions[3] = stopping(beyond);
  run = run_with(problem);
  EXPECT_EQ(run.crossings, all);
  EXPECT_EQ(run.tally.removed.bodies, 1u);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->region, 3u);
}

TEST(Removal, KeepsTheMomentumOfAFreeGas) {
  Problem problem = gas(20);
  problem.world.planes.clear();
  for (Entity i = 0; i < 20; ++i) problem.initial.velocity[i] -= problem.initial.position[i];
  problem.world.regions = {removing(region_at({0, 0, 0}, Volume::sphere(1.4)))};
  const WithRegions run = run_with(problem);
  ASSERT_GT(run.tally.removed.bodies, 3u);
  const Vec3 drift =
      momentum(problem.world, run.end) + run.tally.removed.momentum - momentum(problem.world, problem.initial);
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
  EXPECT_NEAR(run.crossings[1].time, std::sqrt(0.9 * 2 / 10), 1e-13);
  // 0.1 m above the ball that it rested on, it falls as that one did.
  EXPECT_NEAR(run.crossings[2].time, std::sqrt(1.9 * 2 / 10), 1e-13);
  EXPECT_EQ(run.tally.removed.bodies, 3u);
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
  const double height = 0.5 + std::sqrt(1 - 0.51 * 0.51);
  problem.ball({0, height, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.ball({0, 30, 0}, {0, 0, 0}, 1, 0.5, 0);
  problem.world.regions = {removing(region_at({0.51, 0.5, 0}, Volume::sphere(0.1)))};
  problem.world.regions[0].on = {1};
  problem.options.duration = 2;
  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.removed.bodies, 1u);
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
  EXPECT_NEAR(run.tally.removed.energy, 0.25, 1e-15);
  EXPECT_EQ(kinetic_energy(problem.world, run.end), 0);
}

TEST(Removal, OnABentPathBooksTheEnergyThere) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 0.8, 0}, 2, 0.01);
  problem.world.forces.push_back({Attractor{Vec3::Zero(), 1, 0}});
  problem.world.regions = {removing(side_at({0, 0, 0}, {-1, 0, 0}))};
  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.removed.bodies, 1u);
  EXPECT_NEAR(run.tally.removed.energy, 2 * (0.32 - 1), 1e-13);
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
  EXPECT_LT(std::abs(unbooked(problem, run) + run.tally.removed.energy), 1e-11);  // measured: 2e-12
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
  EXPECT_GT(run.tally.removed.bodies, 4u);
  EXPECT_LT(std::abs(unbooked(problem, run) + run.tally.removed.energy), 1e-9);
  EXPECT_LT(run.tally.max_overlap, 1e-11);
  EXPECT_LE(run.tally.resting, 60 - run.tally.removed.bodies);
}

TEST(Removal, ThroughAHoleIsTheEffusionOfAnIdealGas) {
  // 20000 points in a cube of edge 2, with velocities of standard deviation 1 in each direction: A v / (4 V) of them
  // hit an area A of a wall in a second. In so short a time none comes to it twice.
  Problem problem;
  problem.room({-1, -1, -1}, {1, 1, 1});
  Random random;
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(random(1e-12, 1))) * std::cos(2 * std::numbers::pi * random(0, 1));
  };
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const Vec3 x = in_cube(random, 0.999);
    const double vx = normal(), vy = normal(), vz = normal();
    problem.ball(x, {vx, vy, vz}, 1, 1e-6);
  }
  problem.world.regions = {removing(region_at({1, 0, 0}, Volume::box({2e-5, 0.8, 0.8})))};
  problem.options.duration = 0.2;
  const WithRegions run = run_with(problem);
  const double mean = std::sqrt(8 / std::numbers::pi), expected = n * mean * 0.64 / (4 * 8) * 0.2;
  EXPECT_NEAR(static_cast<double>(run.tally.removed.bodies), expected, 4 * std::sqrt(expected));  // 128 +- 45
}

TEST(Stops, AtTheInstantOfACrossing) {
  Problem problem = gas(20);
  problem.world.regions = {stopping(region_at({1.5, -1.5, 1.5}, Volume::sphere(0.5)))};
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->reason, EndReason::region);
  ASSERT_EQ(run.crossings.size(), 1u);
  EXPECT_EQ(run.tally.end->time, run.crossings[0].time);
  EXPECT_EQ(run.end.time, run.crossings[0].time);
  EXPECT_NEAR((run.end.position[run.crossings[0].body] - Vec3(1.5, -1.5, 1.5)).norm(), 0.5, 1e-15);
}

TEST(Stops, EndWhatIsWatched) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  const Entity ball = problem.ball({0, 0, 0}, Vec3::Zero(), 1, 0.1);
  problem.world.regions = {stopping(region_at({0, -2, 0}, Volume::box({10, 2, 10})))};
  problem.options.duration = 5;
  problem.options.watch = {{Quantity::y, ball, 1}};
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 1);  // it enters at y = -1, after sqrt(0.2) s
  EXPECT_NEAR(simulator->extremes()[0].least.value, -1, 1e-14);
  EXPECT_NEAR(simulator->extremes()[0].least.time, std::sqrt(0.2), 1e-14);
}

TEST(Stops, RecordAllThatEnterAtThatInstant) {
  Problem problem;
  problem.ball({-4, 3, 0}, {1, 0, 0});
  problem.ball({4, -3, 0}, {-1, 0, 0});
  problem.ball({4, 7, 0}, {-1, 0, 0});
  problem.world.regions = {stopping(region_at({0, 0, 0}, Volume::box({1.5, 20, 1})))};
  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 3u);
  for (Entity i = 0; i < 3; ++i) EXPECT_EQ(run.crossings[i], (RegionCrossing{3.25, 0, i, true}));
}

TEST(Stops, AfterTheCollisions) {
  Problem problem = gas(20);
  problem.world.regions.clear();
  const WithRegions whole = run_with(problem);
  for (const uint64_t n : {1u, 7u, 100u}) {
    problem.options.stop_collisions = n;
    const WithRegions run = run_with(problem);
    ASSERT_TRUE(run.tally.end);
    EXPECT_EQ(run.tally.end->reason, EndReason::collisions);
    EXPECT_EQ(run.tally.collisions(), n);
    EXPECT_EQ(run.tally.end->time, whole.all[n - 1].time);
    EXPECT_EQ(run.end.time, whole.all[n - 1].time);
    EXPECT_LT(std::abs(residual(problem, run)), 1e-12);
  }
}

TEST(Stops, AfterACollisionLetCrossingsOfThatInstantHappen) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0});
  problem.ball({1, 0, 0}, {0, 0, 0});
  problem.ball({-2, 9, 0}, {1, 0, 0});
  problem.world.regions = {removing(region_at({1, 9, 0}, Volume::box({2, 2, 2})))};
  problem.options.stop_collisions = 1;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->time, 2);
  EXPECT_EQ(run.crossings, (vector<RegionCrossing>{{2, 0, 2, true}}));
  EXPECT_EQ(run.tally.removed.bodies, 1u);
}

TEST(Stops, CountCollisionsOfOneInstantTogether) {
  Problem problem;
  problem.room({-2, -2, -2}, {2, 2, 2});
  problem.ball({-1, 0, 0}, {-1, 0, 0});
  problem.ball({1, 0, 0}, {1, 0, 0});
  problem.options.stop_collisions = 1;
  const WithRegions run = run_with(problem);
  EXPECT_EQ(run.tally.collisions(), 2u);
  EXPECT_EQ(run.end.velocity[0], Vec3(1, 0, 0));
  EXPECT_EQ(run.end.velocity[1], Vec3(-1, 0, 0));
}

TEST(Stops, AtRestWhenTheBouncesHaveEnded) {
  // Dropped by h, e = 1/2: at rest after sqrt(2 h / g) (1 + e) / (1 - e) = 3 s.
  Problem problem;
  problem.world.gravity = Vec3(0, -2, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 1.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->reason, EndReason::rest);
  EXPECT_NEAR(run.tally.end->time, 3, 3e-15);
  EXPECT_EQ(run.tally.resting, 1u);
}

TEST(Stops, AtOnceWhereNothingMoves) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.options.stop_at_rest = true;
  EXPECT_EQ(run_with(problem).tally.end->time, 0);
  problem.world.gravity = Vec3(0, -1, 0);
  EXPECT_FALSE(run_with(problem).tally.end);
  problem.plane({0, -0.5, 0}, {0, 1, 0});
  EXPECT_EQ(run_with(problem).tally.end->time, 0);
  // It slides on.
  problem.initial.velocity[0] = Vec3(1, 0, 0);
  EXPECT_FALSE(run_with(problem).tally.end);
}

TEST(Stops, AtRestWaitForAForceThatIsToCome) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.world.forces.push_back({UniformForce{Vec3(1, 0, 0)}, 2, 3});
  problem.options.stop_at_rest = true;
  EXPECT_FALSE(run_with(problem).tally.end);
  // A floor holds it against a force in a window: at rest when the window is over.
  problem.world.gravity = Vec3(0, -1, 0);
  problem.plane({0, -0.5, 0}, {0, 1, 0});
  problem.world.forces[0].law = UniformForce{Vec3(0, -1, 0)};
  EXPECT_EQ(run_with(problem).tally.end->time, 3);
}

TEST(Stops, AtRestWaitForThingsThatStartToMoveOrCome) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.options.stop_at_rest = true;
  problem.options.duration = 20;
  // A floor that rises from 3 to 4 s at 1 m/s throws the ball up at its end. It comes to rest 0.2 s / (1 - e) later.
  problem.move(1, {{3, 4, {0, 1, 0}}});
  WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_NEAR(run.tally.end->time, 4.4, 1e-14);
  EXPECT_NEAR(run.end.position[0].y(), 1.5, 1e-14);
  // A wall comes along: it strikes the ball after 2 s.
  problem.world.motions.clear();
  problem.plane({-2.5, 0, 0}, {1, 0, 0});
  problem.move(2, {{0, 1e3, {1, 0, 0}}});
  problem.options.duration = 5;
  run = run_with(problem);
  ASSERT_FALSE(run.all.empty());
  EXPECT_NEAR(run.all[0].time, 2, 1e-14);
}

TEST(Stops, AtRestOfAPile) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.room({-1.1, 0, -1.1}, {1.1, 9, 1.1});
  Random random;
  for (int k = 0; k < 12; ++k)
    problem.ball({-0.5 + (k % 2), 0.6 + 1.1 * (k / 2), 0.1 * random(-1, 1)}, {0, 0, 0}, 1, 0.5, 0.3);
  problem.options.duration = 200;
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_LT(run.tally.end->time, 100);
  for (const Vec3& v : run.end.velocity) EXPECT_EQ(v, Vec3(0, 0, 0));
  EXPECT_EQ(run.tally.resting, 12u);
}

TEST(Stops, AtRestWhenAllOthersHaveLeft) {
  Problem problem;
  problem.ball({0, 0, 0}, {0, 0, 0});
  problem.ball({0, 5, 0}, {1, 0, 0});
  problem.world.regions = {removing(side_at({4, 0, 0}, {1, 0, 0}))};
  problem.options.stop_at_rest = true;
  const WithRegions run = run_with(problem);
  ASSERT_TRUE(run.tally.end);
  EXPECT_EQ(run.tally.end->time, 4);
}

TEST(Stops, OfTheBooksEngineAreAtFrames) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.world.regions = {stopping(side_at({1.01, 0, 0}, {1, 0, 0}))};
  BookOptions options;
  options.step = 0.25;
  const auto simulator = make_book_simulator(problem.world, problem.initial, options);
  vector<RegionCrossing> crossings;
  for (const double time : {0.0, 1.0, 1.1, 1.2, 1.3, 2.0}) {
    simulator->advance_to(time);
    crossings.insert(crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
    EXPECT_EQ(simulator->tally().end.has_value(), time >= 1.25);
  }
  EXPECT_EQ(crossings, (vector<RegionCrossing>{{1.25, 0, 0, true}}));
  EXPECT_EQ(simulator->state().position[0], Vec3(1.25, 0, 0));
}

}  // namespace
}  // namespace carom
