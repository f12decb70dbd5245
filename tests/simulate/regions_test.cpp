// Crossings of regions along paths of every kind, and their times.
#include <gtest/gtest.h>

#include <numbers>

#include "physics/attractor.h"
#include "simulate/regions.h"
#include "std.h"

namespace carom {
namespace {

TEST(Regions, AreEnteredAndLeftAtTheTimesOfTheClosedForm) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 3;
  problem.ball({0, 0, 0}, {2, 12, 0});
  problem.world.regions = {side_at({0, 5, 0}, {0, 1, 0}), region_at({2, 0, 0}, Volume::box({1, 100, 1}))};

  const WithRegions run = run_with(problem);
  ASSERT_EQ(run.crossings.size(), 4u);

  const double root = sqrt(144 - 10 * g_n);
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

  const double fall = sqrt(0.75);
  for (size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(run.crossings[k].region, 0u) << "at its lowest point it touches the other one";
    EXPECT_EQ(run.crossings[k].enters, k % 2 == 0);
    const double bounce = 1 + 2 * floor(static_cast<double>(k) / 2);
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
  problem.ball({1 - e, 0, 0}, {0, sqrt((1 + e) / (1 - e)), 0}, 1, 0.01);
  problem.world.forces.push_back({Attractor{Vec3::Zero(), 1, 0}});
  problem.world.regions = {side_at({0, 0, 0}, {-1, 0, 0}), region_at({0, 0, 0}, Volume::sphere(1))};
  problem.options.duration = 4 * pi;
  const WithRegions run = run_with(problem);
  // r = 1 - e cos E is 1 at E = pi/2.
  const double half = std::acos(e) - e * std::sin(std::acos(e)), middle = pi / 2 - e;
  map<uint32_t, vector<double>> times;
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
  EXPECT_NEAR(run.crossings[1].time, -2 * log(1.5 / 16), 1e-14 * 5);
  EXPECT_NEAR(run.crossings[2].time, -2 * log(0.5 / 16), 1e-14 * 7);
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
    for (const double node : {0.5 - sqrt(1.0 / 12), 0.5 + sqrt(1.0 / 12)}) {
      const double sine = std::sin(a / 2) * std::cosh(s * (i + node) / parts);
      time += 0.5 * s / parts / sqrt(1 - sine * sine);
    }
  EXPECT_NEAR(run.crossings[0].time, time, 1e-11);  // measured: 3e-13
}

TEST(Regions, CountAsDenseSamplesOfTheFlightsDo) {
  const Problem problem = gas_among_regions(20);
  const WithRegions run = run_with(problem);

  map<pair<uint32_t, Entity>, int> count, sampled;
  for (const RegionCrossing& crossing : run.crossings) ++count[{crossing.region, crossing.body}];

  // By samples.
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  map<pair<uint32_t, Entity>, bool> inside;
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

/// A ball on a rod goes round 3,183 times in a slice of the run in which nothing else happens.
TEST(Regions, AreCrossedAnyNumberOfTimesBetweenOtherEvents) {
  Problem problem;
  problem.ball({1, 0, 0}, {0, 2e5, 0}, 1, 0.1);
  problem.world.strings = {{0, no_entity, Vec3::Zero(), 1, 0, true}};
  problem.world.regions = {side_at({0, 0, 0}, {0, 1, 0})};
  problem.options.duration = 0.1;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  vector<RegionCrossing> crossings;
  while (simulator->time() < problem.options.duration) {
    const double before = simulator->time();
    simulator->advance_to(problem.options.duration);
    EXPECT_GT(simulator->time(), before);
    EXPECT_LE(simulator->crossings().size(), 4096u);
    crossings.insert(crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
  }

  ASSERT_EQ(crossings.size(), 6367u);
  for (size_t k = 1; k < crossings.size(); ++k)
    ASSERT_NEAR(crossings[k].time, double(k) * std::numbers::pi / 2e5, 1e-12) << k;
}

TEST(Regions, TakeTurnsInOrderOfTimeAndChangeNothing) {
  const Problem problem = gas_among_regions(30);
  const WithRegions run = run_with(problem), sliced = run_with(problem, 0.01);
  Problem without = problem;
  without.world.regions.clear();
  const WithRegions plain = run_with(without);

  EXPECT_EQ(run.crossings, sliced.crossings);
  EXPECT_EQ(run.end.position, plain.end.position);
  EXPECT_EQ(run.end.velocity, plain.end.velocity);

  ASSERT_EQ(run.all.size(), plain.all.size());
  for (size_t k = 0; k < run.all.size(); ++k) EXPECT_EQ(run.all[k].time, plain.all[k].time);

  // Each body goes in and out by turns.
  map<pair<uint32_t, Entity>, bool> inside;
  for (size_t k = 0; k < run.crossings.size(); ++k) {
    const RegionCrossing& crossing = run.crossings[k];
    bool& now = inside[{crossing.region, crossing.body}];
    EXPECT_NE(now, crossing.enters);
    now = crossing.enters;
    EXPECT_LE(k > 0 ? run.crossings[k - 1].time : 0, crossing.time);
  }
}

TEST(Regions, ScaleByPowersOfTwoAndTurnWithTheAxes) {
  const WithRegions run = run_with(gas_among_regions(20));

  Problem scaled = gas_among_regions(20);
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
  Problem mirrored = gas_among_regions(20);
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

}  // namespace
}  // namespace carom
