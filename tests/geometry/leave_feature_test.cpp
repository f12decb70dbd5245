// When a contact that slides over a face reaches its rim, and the feature beyond.
#include <gtest/gtest.h>

#include "geometry/round_prism.h"
#include "physics/world.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using namespace by_hand;

uint8_t feature(int x, int y, int z) {
  return PrismFeature{x, y, z}.code();
}

FeatureTime leave(const Volume& a, const Volume& b, uint8_t from, const Vec3& d, const Vec3& w,
                  const Vec3& acceleration = Vec3::Zero()) {
  return leave_feature(body_and_obstacle(a, b), 0, 1, from, {d, w, acceleration, w.norm(), false}, 100);
}

TEST(LeaveFeature, ABallLeavesABoxesFaceOverTheEdgeBelowItsCentre) {
  const FeatureTime m = leave(ball, brick, feature(0, -1, 0), {0.25, -1.5, 0}, {-0.5, 0, 0.25});
  EXPECT_EQ(m.time, 1.5);
  EXPECT_EQ(m.feature, feature(-1, -1, 0));
  // Pulled back before the one rim, over the other one.
  const FeatureTime back = leave(ball, brick, feature(0, -1, 0), {0, -1.5, 0}, {0.5, 0, 0}, {-1, 0, 0});
  EXPECT_NEAR(back.time, 0.5 + sqrt(1.25), 4e-16);
  EXPECT_EQ(back.feature, feature(-1, -1, 0));
}

TEST(LeaveFeature, ABoxLeavesABoxWhereTheirEdgesPart) {
  const FeatureTime m = leave(brick, brick, feature(0, -1, 0), {0, -2, 1}, {0.25, 0, 1});
  EXPECT_EQ(m.time, 2);
  EXPECT_EQ(m.feature, feature(0, 0, 1)) << "sharp: the face beyond";
}

TEST(LeaveFeature, ABallLeavesACapOverItsRimAndACylinderLeavesACapWhereTheDiscsPart) {
  const FeatureTime rim = leave(ball, can, feature(0, -1, 0), {0.3, -1.5, 0}, {0, 0, 0.2});
  EXPECT_NEAR(rim.time, 2, 1e-15);  // 0.3-0.4-0.5
  EXPECT_EQ(rim.feature, feature(1, -1, 1));
  const FeatureTime part = leave(can, can, feature(0, -1, 0), {0.6, -2, 0}, {0, 0, 0.2});
  EXPECT_NEAR(part.time, 4, 1e-15);
  EXPECT_EQ(part.feature, feature(1, 0, 1));
}

TEST(LeaveFeature, ACylinderLeavesABoxOverItsSidesAndRoundItsCorners) {
  const FeatureTime side = leave(can, brick, feature(0, -1, 0), {0, -2, 1}, {0.5, 0, 0});
  EXPECT_EQ(side.time, 2);
  EXPECT_EQ(side.feature, feature(1, 0, 0));
  // Beyond the rectangle's corner (0.5, 1.5) by (0.3, 0.4).
  const FeatureTime corner = leave(can, brick, feature(0, -1, 0), {0, -2, 1.1}, {0.4, 0, 0.4});
  EXPECT_NEAR(corner.time, 2, 1e-15);
  EXPECT_EQ(corner.feature, feature(1, 0, 1));
}

TEST(LeaveFeature, RoundEdgesEndAtTheirFacesAndCorners) {
  // Up along a box's upright edge, and round it to its side.
  EXPECT_EQ(leave(ball, brick, feature(1, 0, 1), {0.8, 0, 1.9}, {0, 0.5, 0}).feature, feature(1, 1, 1));
  const FeatureTime round = leave(ball, brick, feature(1, 0, 1), {0.75, 0, 1.9}, {-0.5, 0, 0.3});
  EXPECT_EQ(round.time, 0.5);
  EXPECT_EQ(round.feature, feature(0, 0, 1));
  EXPECT_EQ(leave(ball, can, feature(1, 0, 1), {1, 0.5, 0}, {0, 0.5, 0}).time, 1);
  EXPECT_EQ(leave(ball, can, feature(1, 1, 1), {0.8, 1.4, 0}, {-0.5, 0, 0}).feature, feature(0, 1, 0));
}

TEST(LeaveFeature, WallsAreLeftOverTheirRimToo) {
  World world = body_and_obstacle(ball, ball);
  world.obstacles.clear();
  world.walls = {make_wall(Vec3::UnitY(), Vec3::UnitZ(), 2, 1)};  // right is -x
  const RelativeMotion m{{0, -0.5, 0}, {-1, 0, 0}, Vec3::Zero(), 1, false};

  const FeatureTime rim = leave_feature(world, 0, 1, wall_front, m, 10);
  EXPECT_EQ(rim.time, 2);
  EXPECT_EQ(rim.feature, wall_edges + 1) << "left";

  for (const Volume& v : {can, brick}) {
    world.volume = {v};
    const RelativeMotion n{{0, -1, 0}, {-1, 0, 0}, Vec3::Zero(), 1, false};
    const FeatureTime touched =
        time_of_impact(world, 0, 1, {{0, -3, 0}, {0, 1, 0}, Vec3::Zero(), 1, false}, no_feature, 10);
    ASSERT_EQ(touched.time, 2);
    EXPECT_TRUE(is_flat(world, 0, 1, touched.feature));
    EXPECT_EQ(leave_feature(world, 0, 1, touched.feature, n, 10).time, 2.5);
  }
}

TEST(LeaveFeature, BeyondTheRimThePairIsApart) {
  // Every pair slides along the face that it has met. It touches until it leaves the face, and not after that.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(11);
      int left = 0;
      for (int k = 0; k < 300; ++k) {
        World world = pair_world(ka, kb, false, random, 0.1);
        const Vec3 d = random.uniform(2, 5) * random.direction(), w = -(d + random.vector(0.5));
        const FeatureTime m = time_of_impact(world, 0, 1, {d, w, Vec3::Zero(), w.norm(), false}, no_feature, 10);
        if (m.time == never || !is_flat(world, 0, 1, m.feature)) continue;

        const Thing a = of(world, 0), b = of(world, 1);
        const double size = a.half.norm() + b.half.norm();
        const auto place = [&](const Vec3& x) {
          if (!world.walls.empty()) world.walls[0].center = x;
          return x;
        };

        const Vec3 x = place(d + m.time * w), n = touch(world, 0, Vec3::Zero(), 1, x, m.feature).normal;
        const Vec3 slide = n.cross(random.direction());
        const Vec3 pull = k % 2 == 0 ? Vec3::Zero() : Vec3(n.cross(random.direction()));
        const FeatureTime rim = leave_feature(world, 0, 1, m.feature, {x, slide, pull, 1, false}, 100);
        ASSERT_LT(rim.time, never) << name(ka) << " " << name(kb);
        ASSERT_NE(rim.feature, no_feature);
        ASSERT_NE(rim.feature, m.feature);
        ++left;

        const auto gap_at = [&](double t) {
          const Vec3 p = place(x + t * (slide + 0.5 * t * pull));
          return touch(world, 0, Vec3::Zero(), 1, p).gap;
        };
        for (int i = 0; i < 10; ++i) EXPECT_LT(gap_at(rim.time * 0.1 * i), 1e-13 * size) << name(ka) << " " << name(kb);
        EXPECT_LT(gap_at(rim.time * (1 - 1e-9)), 1e-13 * size) << name(ka) << " " << name(kb);
        EXPECT_GT(gap_at(rim.time + 1e-4 * size), 1e-13 * size) << name(ka) << " " << name(kb) << int(m.feature);

        // The feature beyond counts as just left, and the pair is pulled back: it does not meet the rim again at once.
        const Vec3 edge = place(x + rim.time * (slide + 0.5 * rim.time * pull)), v = slide + rim.time * pull;
        const FeatureTime next = time_of_impact(world, 0, 1, {edge, v, -1e-3 * n, v.norm(), false}, rim.feature, 10);
        // Over a round rim it flies off where its speed bends the gap open faster than the pull closes it.
        const Vec3 beyond = touch(world, 0, Vec3::Zero(), 1, edge, rim.feature).normal;
        const double bend =
            (beyond - n).norm() > 1e-6 ? 1 : bending(world, 0, Vec3::Zero(), 1, edge, {0, n, edge, rim.feature}, v);

        if (bend > 0.9e-3 && bend < 1.1e-3) continue;
        const bool flies = bend > 1e-3;
        EXPECT_EQ(next.time > 0, flies) << name(ka) << " " << name(kb) << " from " << int(m.feature) << " to "
                                        << int(rim.feature);
      }

      EXPECT_GT(left, ka == Kind::sphere && kb == Kind::sphere ? -1 : 20) << name(ka) << " " << name(kb);
    }
}

}  // namespace
}  // namespace carom
