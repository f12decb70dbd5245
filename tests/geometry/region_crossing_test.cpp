// Crossings of regions and single paths, against roots found in extended precision by bisection between samples.
#include "geometry/region_crossing.h"

#include <gtest/gtest.h>

#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

WorldRegion region_of(const Vec3& position, const Volume& volume) {
  WorldRegion region;
  region.position = position;
  region.volume = volume;
  return region;
}

WorldRegion side_of(const Vec3& point, const Vec3& normal) {
  WorldRegion region;
  region.position = point;
  region.normal = normal;
  return region;
}

using Long = long double;

/// How far a point of the path is outside, on no particular scale; below 0: inside.
Long outside(const WorldRegion& region, const function<Long(int, Long)>& path, Long t) {
  Long d[3];
  for (int k = 0; k < 3; ++k) d[k] = path(k, t) - Long{region.position[k]};
  if (region.is_side())
    return -(d[0] * Long{region.normal[0]} + d[1] * Long{region.normal[1]} + d[2] * Long{region.normal[2]});

  const Vec3& half = region.volume.half;
  const Long r = half.x();
  if (region.volume.shape == Shape::sphere) return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - r * r;
  if (region.volume.shape == Shape::cylinder)
    return std::max(d[0] * d[0] + d[2] * d[2] - r * r, std::abs(d[1]) - Long{half.y()});

  Long most = std::abs(d[0]) - Long{half.x()};
  for (int k = 1; k < 3; ++k) most = std::max(most, std::abs(d[k]) - Long{half[k]});
  return most;
}

/// The times of all changes of sign between samples.
vector<double> changes(const WorldRegion& region, const function<Long(int, Long)>& path, double length) {
  constexpr int samples = 4000;
  vector<double> times;
  for (int i = 0; i < samples; ++i) {
    Long l = Long{length} * i / samples, r = Long{length} * (i + 1) / samples;
    const bool before = outside(region, path, l) < 0;
    if (before == (outside(region, path, r) < 0)) continue;

    for (int k = 0; k < 80; ++k) {
      const Long middle = (l + r) / 2;
      ((outside(region, path, middle) < 0) == before ? l : r) = middle;
    }
    times.push_back(static_cast<double>(r));
  }
  return times;
}

/// All crossings of a path by the program, as the simulator follows them.
vector<double> crossings(const WorldRegion& region, const CenterPath& path, bool inside, double margin) {
  vector<double> times;
  double from = 0;
  while (const auto next = next_crossing(region, path, from, inside, margin)) {
    times.push_back(next->at);
    from = next->sure;
    inside = !inside;
  }
  return times;
}

/// Regions of every shape, about as large as the cube of edge 2.
vector<WorldRegion> regions_near(Random& random) {
  const Vec3 at = in_cube(random, 1);
  return {side_of(at, in_cube(random, 1).normalized()), region_of(at, Volume::sphere(random(0.2, 1))),
          region_of(at, Volume::cylinder(random(0.2, 1), random(0.3, 2))),
          region_of(at, Volume::box({random(0.3, 2), random(0.3, 2), random(0.3, 2)}))};
}

TEST(RegionCrossing, OfAParabolaIsRightToTheRoundingOfItsTime) {
  Random random;
  int found = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Vec3 x = in_cube(random, 2), v = in_cube(random, 1) - x, a = in_cube(random, 1);
    const auto path = [&](int k, Long t) { return Long{x[k]} + t * (Long{v[k]} + t * Long{a[k]} / 2); };

    for (const WorldRegion& region : regions_near(random)) {
      const vector<double> expected = changes(region, path, 3);
      const vector<double> times =
          crossings(region, CenterPath::along(x, v, a, 3), outside(region, path, 0) < 0, 1e-15);
      ASSERT_EQ(times.size(), expected.size()) << "trial " << trial;
      for (size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 4e-16 * expected[i]);
      found += static_cast<int>(times.size());
    }
  }
  EXPECT_GT(found, 200);
}

TEST(RegionCrossing, OfAPolynomialIsRightToItsRounding) {
  Random random;
  int found = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Vec3 x = in_cube(random, 2);
    PolynomialPath::Terms terms;
    for (Vec3& term : terms) term = in_cube(random, 2);
    terms[0] -= 2 * x;

    const auto path = [&](int k, Long t) {
      Long sum = 0;
      for (size_t n = terms.size(); n-- > 0;) sum = (sum + Long{terms[n][k]}) * (t / 3);
      return Long{x[k]} + sum;
    };

    for (const WorldRegion& region : regions_near(random)) {
      const vector<double> expected = changes(region, path, 3);
      const vector<double> times =
          crossings(region, CenterPath::along(x, terms, 3), outside(region, path, 0) < 0, 1e-14);
      ASSERT_EQ(times.size(), expected.size()) << "trial " << trial;
      for (size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], expected[i], 1e-13);  // measured: 2e-14
      found += static_cast<int>(times.size());
    }
  }
  EXPECT_GT(found, 200);
}

TEST(RegionCrossing, FarAwayASmallSphereIsHitAsExactly) {
  // 2^20 m through a sphere of 2^-7 m, off its middle by 3/5 of the radius: the chord is 8/5 of the radius.
  const double r = 0x1p-7;
  const WorldRegion region = region_of({0x1p20, 0.6 * r, 0}, Volume::sphere(r));
  const auto times =
      crossings(region, CenterPath::along(Vec3::Zero(), {0x1p10, 0, 0}, Vec3::Zero(), 4096), false, 1e-9);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 1024 - 0.8 * r / 1024, 1024 * 0x1p-52);
  EXPECT_NEAR(times[1], 1024 + 0.8 * r / 1024, 1024 * 0x1p-52);
}

TEST(RegionCrossing, GrazingIsNone) {
  const CenterPath level = CenterPath::along({-3, 0.5, 0}, {1, 0, 0}, Vec3::Zero(), 6);
  EXPECT_TRUE(crossings(region_of(Vec3::Zero(), Volume::sphere(0.5)), level, false, 1e-15).empty());
  EXPECT_TRUE(crossings(region_of(Vec3::Zero(), Volume::box({1, 1, 1})), level, false, 1e-15).empty());
  EXPECT_TRUE(crossings(region_of(Vec3::Zero(), Volume::cylinder(0.5, 1)), level, false, 1e-15).empty());
  EXPECT_TRUE(crossings(side_of({0, 0.5, 0}, {0, -1, 0}), level, false, 1e-15).empty());
  // Up to the plane, and back.
  const CenterPath thrown = CenterPath::along({0, 0, 0}, {0, 4, 0}, {0, -8, 0}, 1);
  EXPECT_TRUE(crossings(side_of({0, 1, 0}, {0, 1, 0}), thrown, false, 1e-15).empty());
  EXPECT_EQ(crossings(side_of({0, 0.75, 0}, {0, 1, 0}), thrown, false, 1e-15), (vector<double>{0.25, 0.75}));
}

TEST(RegionCrossing, OneCornerOfABoxIsCutOff) {
  // Along x + y = 1.5 in the square from 0 to 1: in at y = 1, out at x = 1.
  const WorldRegion box = region_of({0.5, 0.5, 0.5}, Volume::box({1, 1, 1}));
  const CenterPath path = CenterPath::along({-1, 2.5, 0.5}, {1, -1, 0}, Vec3::Zero(), 8);
  EXPECT_EQ(crossings(box, path, false, 1e-15), (vector<double>{1.5, 2}));
  // Through the edge itself: nothing.
  const CenterPath edge = CenterPath::along({-1, 3, 0.5}, {1, -1, 0}, Vec3::Zero(), 8);
  EXPECT_TRUE(crossings(box, edge, false, 1e-15).empty());
}

TEST(RegionCrossing, FromTheBoundaryAPathEntersAtOnceOrNever) {
  const WorldRegion up = side_of(Vec3::Zero(), {0, 1, 0});
  const auto along = [](double speed) { return CenterPath::along(Vec3::Zero(), {1, speed, 0}, Vec3::Zero(), 1); };
  EXPECT_EQ(crossings(up, along(1), false, 1e-15), (vector<double>{0}));
  EXPECT_TRUE(crossings(up, along(-1), false, 1e-15).empty());
  EXPECT_TRUE(crossings(up, along(0), false, 1e-15).empty());
  EXPECT_TRUE(crossings(up, along(1), true, 1e-15).empty());
  EXPECT_EQ(crossings(up, along(-1), true, 1e-15), (vector<double>{0}));
}

}  // namespace
}  // namespace carom
