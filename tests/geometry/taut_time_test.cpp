// When a string goes taut: the inside of a sphere.
#include <gtest/gtest.h>

#include <random>

#include "geometry/contact_time.h"
#include "geometry/path_time_of_impact.h"
#include "geometry/touch.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

double taut(const Vec3& d, const Vec3& w, const Vec3& a = Vec3::Zero(), double length = 1, double horizon = 1e9,
            bool left = false) {
  return taut_time({d, w, a, 2 * w.norm(), left}, length, horizon);
}

TEST(TautTime, AStraightPathReachesTheSphereFromInside) {
  EXPECT_EQ(taut({0.5, 0, 0}, {0.25, 0, 0}), 2);
  EXPECT_EQ(taut({0.5, 0, 0}, {-0.25, 0, 0}), 6);
  EXPECT_NEAR(taut({0, 0.6, 0}, {1, 0, 0}), 0.8, 1e-16);
  EXPECT_EQ(taut({0.5, 0, 0}, {0, 0, 0}), never);
  EXPECT_EQ(taut({0.5, 0, 0}, {0.25, 0, 0}, Vec3::Zero(), 1, 1.5), never) << "after the horizon";
}

TEST(TautTime, AStringThatHasJustBeenTautIsTautAgainAfterTheWholeChord) {
  for (double angle = 1; angle > 1e-9; angle /= 10) {
    const Vec3 w(-std::cos(angle), std::sin(angle), 0);
    EXPECT_NEAR(taut({1, 0, 0}, w, Vec3::Zero(), 1, 1e9, true) / (2 * std::cos(angle)), 1, 1e-15) << angle;
  }
}

TEST(TautTime, AParabolaReachesTheSphereAtItsRoot) {
  // Up with v from the lowest point: taut again at the same place, after the hop, or at the highest one.
  EXPECT_NEAR(taut({0, -1, 0}, {0, 4, 0}, {0, -10, 0}, 1, 1e9, true), 0.8, 1e-15);
  EXPECT_NEAR(taut({0, -1, 0}, {0, 10, 0}, {0, -10, 0}, 1, 1e9, true), 1 - sqrt(0.6), 1e-15);
  // From rest at the side: 1 = (0.6)^2 + (5 t^2)^2.
  EXPECT_NEAR(taut({0.6, 0, 0}, {0, 0, 0}, {0, -10, 0}), 0.4, 1e-15);
}

TEST(TautTime, ATautStringIsTautAtOnceWhereNothingTurnsItsEndBack) {
  EXPECT_EQ(taut({1, 0, 0}, {1e-3, 0, 0}), 0);
  EXPECT_EQ(taut({1, 0, 0}, {0, 1, 0}), 0);
  EXPECT_EQ(taut({1, 0, 0}, {0, 1, 0}, {-0.5, 0, 0}), 0) << "the path turns less than the sphere";
  EXPECT_GT(taut({1, 0, 0}, {0, 1, 0}, {-2, 0, 0}), 0.5) << "the path turns more than the sphere";
  EXPECT_EQ(taut({0, -1, 0}, {0, 0, 0}, {0, -10, 0}), 0);
  EXPECT_EQ(taut({1, 0, 0}, {0, 0, 0}), never);
}

TEST(TautTime, PolynomialsAgreeWithParabolas) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> of(-1, 1);
  int found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 d = 0.5 * Vec3(of(random), of(random), of(random)), w(of(random), of(random), of(random)),
               a = 4 * Vec3(of(random), of(random), of(random));
    const double length = 0.9;

    PolynomialPath::Terms terms;
    terms.fill(Vec3::Zero());
    terms[0] = length * w;
    terms[1] = 0.5 * length * length * a;

    const double one = taut(d, w, a, 1, length), other = taut_time(d, terms, length, 1, 2 * w.norm(), false, length);
    if (one == never) {
      EXPECT_EQ(other, never);
      continue;
    }

    ++found;
    EXPECT_NEAR(one, other, 1e-14);
    EXPECT_NEAR((d + one * (w + 0.5 * one * a)).norm(), 1, 4e-16);
  }

  EXPECT_GT(found, 500);
}

TEST(TautTime, TheGapOfAStringIsTheRestOfItsLengthAndItsNormalPointsOutward) {
  World world;
  world.mass = {1};
  world.radius = {0.1};
  world.restitution = {1};
  world.strings.push_back({0, no_entity, Vec3(1, 2, 3), 5, 0.5, false});
  const Touch there = touch(world, 0, {1, 2, 6}, 1, {1, 2, 3});
  EXPECT_EQ(there.gap, 2);
  EXPECT_EQ(there.normal, Vec3(0, 0, 1));
  EXPECT_EQ(there.point, Vec3(1, 2, 6));
  EXPECT_FALSE(is_flat(world, 0, 1, 0));
  // The gap's second derivative at the speed v across: -v^2 / |d|.
  EXPECT_NEAR(bending(world, 0, {1, 2, 6}, 1, {1, 2, 3}, there, {2, 0, 7}), -4.0 / 3, 1e-15);
}

}  // namespace
}  // namespace carom
