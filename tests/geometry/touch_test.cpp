#include "geometry/touch.h"

#include <gtest/gtest.h>

#include "physics/world.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using namespace by_hand;

Touch touch_of(const Volume& a, const Volume& b, const Vec3& d) {
  return touch(body_and_obstacle(a, b), 0, Vec3::Zero(), 1, d);
}

void expect_touch(const Touch& t, double gap, const Vec3& normal, const Vec3& point) {
  EXPECT_NEAR(t.gap, gap, 4e-16);
  EXPECT_LT((t.normal - normal).norm(), 4e-16) << t.normal.transpose();
  EXPECT_LT((t.point - point).norm(), 1e-15) << t.point.transpose();
}

TEST(Touch, ABallAndAFaceAreAsFarApartAsTheyAreAlongTheFacesNormal) {
  expect_touch(touch_of(ball, brick, {0.25, 2.0, 1}), 0.5, Vec3::UnitY(), {0, 0.5, 0});
  expect_touch(touch_of(brick, ball, {0.25, -2.0, 1}), 0.5, -Vec3::UnitY(), {0.25, -1, 1});
  expect_touch(touch_of(ball, can, {0.25, 2, 0}), 0.5, Vec3::UnitY(), {0, 0.5, 0});
  expect_touch(touch_of(ball, can, {0, 0.5, -1.25}), 0.25, -Vec3::UnitZ(), {0, 0, -0.5});
}

TEST(Touch, AnEdgeACornerAndARimHaveTheNormalOfTheirNearestPoint) {
  expect_touch(touch_of(brick, ball, {0.5 + 3, 1 + 4, 0}), 4.5, {0.6, 0.8, 0}, {0.5, 1, 0});
  expect_touch(touch_of(brick, ball, {0.5 + 2, 1 + 3, -1.5 - 6}), 6.5, Vec3(2, 3, -6) / 7, {0.5, 1, -1.5});
  const double s = sqrt(0.5);
  expect_touch(touch_of(can, ball, {(0.5 + 3) * s, 1 + 4, (0.5 + 3) * s}), 4.5, {0.6 * s, 0.8, 0.6 * s},
               {0.5 * s, 1, 0.5 * s});
}

TEST(Touch, SharpVolumesApartAreAsFarAsTheirNearestPoints) {
  expect_touch(touch_of(brick, brick, {1 + 3, 2 + 4, 0}), 5, {0.6, 0.8, 0}, {0.5, 1, 0});
  expect_touch(touch_of(can, can, {0, 2 + 4, 1 + 3}), 5, {0, 0.8, 0.6}, {0, 1, 0.5});
  expect_touch(touch_of(can, brick, {1 + 5, 0, 1}), 5, Vec3::UnitX(), {0.5, 0, 0});
  expect_touch(touch_of(can, brick, {0.5 + 3, 0, 1.5 + 4}), 4.5, {0.6, 0, 0.8}, {0.3, 0, 0.4});
}

TEST(Touch, AnAreaIsTouchedInItsMiddle) {
  expect_touch(touch_of(brick, brick, {0.5, 2, 1}), 0, Vec3::UnitY(), {0.25, 1, 0.5});
  expect_touch(touch_of(can, can, {0.5, -2, 0}), 0, -Vec3::UnitY(), {0.25, -1, 0});
  expect_touch(touch_of(can, brick, {0.75, 2, 0}), 0, Vec3::UnitY(), {0.375, 1, 0});
  expect_touch(touch_of(can, can, {0, 1, 1}), 0, Vec3::UnitZ(), {0, 0.5, 0.5});
}

TEST(Touch, OverlapIsTheLeastWayOut) {
  expect_touch(touch_of(brick, brick, {0.875, 1, 1}), -0.125, Vec3::UnitX(), {0.4375, 0.5, 0.5});
  EXPECT_NEAR(touch_of(can, can, {0.3, 0.4, 0.4}).gap, -0.5, 1e-16);
  EXPECT_EQ(touch_of(brick, brick, Vec3::Zero()).normal, Vec3::UnitX()) << "the least width's";
  EXPECT_EQ(touch_of(ball, ball, Vec3::Zero()).normal.norm(), 1) << "one centre: some normal";
  EXPECT_EQ(touch_of(ball, can, Vec3::Zero()).gap, -1) << "inside a rim too";
}

TEST(Touch, BoxesThatTouchAtAnEdgeOnlyHaveOneFacesNormal) {
  EXPECT_EQ(touch_of(brick, brick, {1, 2, 0}).normal, Vec3::UnitX()) << "a tie: x before y";
  EXPECT_EQ(touch_of(brick, brick, {0, 2, -3}).normal, Vec3::UnitY()) << "a tie: y before z";
  EXPECT_EQ(touch_of(brick, brick, {1, 2 + 0x1p-51, 0}).normal, Vec3::UnitY()) << "farther apart in y";
}

TEST(Touch, APlaneIsMetWithTheVolumesReachAlongItsNormal) {
  World world = body_and_obstacle(can, ball);
  world.obstacles.clear();
  world.planes = {{Vec3::Zero(), Vec3(0.6, 0.8, 0), nullopt}};
  const Touch t = touch(world, 0, Vec3(0.6, 0.8, 0) * 3, 1, Vec3::Zero());
  EXPECT_NEAR(t.gap, 3 - (0.5 * 0.6 + 0.8), 4e-16);
  EXPECT_EQ(t.normal, Vec3(-0.6, -0.8, 0));
  EXPECT_LT((t.point - (Vec3(1.8, 2.4, 0) + Vec3(-0.5, -1, 0))).norm(), 1e-15);
}

TEST(Touch, TheGapIsExactWhereItIsSmall) {
  // A million away from the origin, positions are multiples of 2^-33; their difference counts in full.
  const World world = body_and_obstacle(brick, brick);
  const Vec3 xa(1e6, 3, 0);
  EXPECT_EQ(touch(world, 0, xa, 1, xa + Vec3(1 + 0x1p-33, 0, 0)).gap, 0x1p-33);
  EXPECT_EQ(touch(world, 0, Vec3(0.1, 0, 0), 1, Vec3(1e6, 0, 0)).gap, 1e6 - 1.1);
  const World balls = body_and_obstacle(ball, ball);
  const double gap = touch(balls, 0, Vec3(-0.3, 0, 0), 1, Vec3(0.7, 0, 0)).gap;
  EXPECT_EQ(gap, static_cast<double>(static_cast<long double>(0.7) + static_cast<long double>(0.3) - 1));
}

TEST(Touch, EveryPairAgreesWithPointsFoundByProjection) {
  // The same with the two exchanged: the normal reversed, the gap equal bit for bit.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(static_cast<unsigned>(10 * static_cast<int>(ka) + static_cast<int>(kb)));
      for (int k = 0; k < 200; ++k) {
        World world = pair_world(ka, kb, true, random);
        const Thing a = of(world, 0), b = of(world, 1);
        const double size = a.half.norm() + b.half.norm();
        const Vec3 d = random.uniform(0.2, 3) * size * random.direction();

        if (!world.walls.empty()) world.walls[0].center = d;
        const double gap = distance(a, b, d, 1e-10, 3000);
        const Touch t = touch(world, 0, Vec3::Zero(), 1, d);
        EXPECT_NEAR(t.normal.norm(), 1, 4e-16);
        if (gap > 1e-3 * size) {
          EXPECT_NEAR(t.gap, gap, 1e-5 * size) << name(ka) << " " << name(kb);
        }

        // A plane between the two at this gap; a point of a that lies at this distance from b.
        EXPECT_NEAR(t.normal.dot(d) - a.support(t.normal) - b.support(t.normal), t.gap, 1e-14 * size)
            << name(ka) << " " << name(kb) << " " << gap;
        if (t.gap > 0) {
          EXPECT_LT((a.nearest(t.point) - t.point).norm(), 1e-14 * size) << name(ka) << " " << name(kb);
          EXPECT_NEAR((b.nearest(t.point - d) + d - t.point).norm(), t.gap, 1e-14 * size) << name(ka) << name(kb);
        }

        if (!world.is_body(1)) continue;
        const Touch swapped = touch(world, 1, d, 0, Vec3::Zero());
        EXPECT_EQ(swapped.gap, t.gap) << name(ka) << " " << name(kb);
        EXPECT_EQ(swapped.normal, Vec3(-t.normal)) << name(ka) << " " << name(kb);
      }
    }
}

TEST(Bending, IsTheGapsSecondDifference) {
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(static_cast<unsigned>(31 * static_cast<int>(ka) + static_cast<int>(kb)));
      int seen = 0;
      for (int k = 0; k < 400; ++k) {
        World world = pair_world(ka, kb, false, random, 0.2);
        const Vec3 d = random.uniform(0.5, 3) * random.direction(), w = random.direction();
        if (!world.walls.empty()) world.walls[0].center = d;
        Touch t = touch(world, 0, Vec3::Zero(), 1, d);
        // At the surface, where the gap is the one in use.
        const Vec3 on = d - t.gap * t.normal;
        const auto at = [&](double s) {
          const Vec3 x = on + s * w;
          if (!world.walls.empty()) world.walls[0].center = x;
          return touch(world, 0, Vec3::Zero(), 1, x, t.feature);
        };
        t = at(0);
        if (!world.walls.empty()) world.walls[0].center = on;
        const Touch there = touch(world, 0, Vec3::Zero(), 1, on);
        if (std::abs(there.gap) > 1e-12 || (t.normal - there.normal).norm() > 1e-9) continue;  // a sharp edge's
        const double bend = bending(world, 0, Vec3::Zero(), 1, on, t, w);
        // Along the surface's tangent, so that at an angle too it is the curvature alone.
        const Vec3 along = w - w.dot(t.normal) * t.normal;
        if (is_flat(world, 0, 1, t.feature)) {
          EXPECT_EQ(bend, 0);
          continue;
        }
        const double h = 1e-4;
        const auto gap = [&](double s) {
          const Vec3 x = on + s * along;
          if (!world.walls.empty()) world.walls[0].center = x;
          return touch(world, 0, Vec3::Zero(), 1, x, t.feature).gap;
        };
        const auto second_difference = [&](double s) { return (gap(s) - 2 * gap(0) + gap(-s)) / (s * s); };
        const double second = second_difference(h);
        // Not across the border of two features, where it depends on the step.
        if (std::abs(second - second_difference(2 * h)) > 1e-3 * (1 + std::abs(second))) continue;
        const double expected = bending(world, 0, Vec3::Zero(), 1, on, t, along);
        EXPECT_NEAR(expected, second, 1e-5 * (1 + std::abs(expected))) << name(ka) << " " << name(kb);
        ++seen;
      }
      const bool curved = ka == Kind::sphere || kb == Kind::sphere || ka == Kind::cylinder;
      EXPECT_GT(seen, curved ? 20 : -1) << name(ka) << " " << name(kb);
    }
}

}  // namespace
}  // namespace carom
