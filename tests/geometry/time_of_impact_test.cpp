// Times of impact: closed forms, symmetries, and the definition of a contact.
#include <gtest/gtest.h>

#include "geometry/round_prism.h"
#include "physics/world.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using namespace by_hand;

RelativeMotion motion(const Vec3& d, const Vec3& w, const Vec3& a = Vec3::Zero()) {
  return {d, w, a, w.cwiseAbs().sum(), false};
}

double meet(const Volume& a, const Volume& b, const Vec3& d, const Vec3& w, const Vec3& acceleration = Vec3::Zero(),
            double horizon = 100) {
  return time_of_impact(two_bodies(a, b), 0, 1, motion(d, w, acceleration), no_feature, horizon).time;
}

const Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), far_z = Vec3::UnitZ(), none = Vec3::Zero();

TEST(TimeOfImpact, HeadOnIsTheGapOverTheSpeed) {
  EXPECT_EQ(meet(brick, brick, {5, 0.5, 1}, -2 * right), 2);
  EXPECT_EQ(meet(brick, ball, {5, 0.5, 1}, -2 * right), 2);
  EXPECT_EQ(meet(can, can, {5, 1.5, 0}, -2 * right), 2);
  EXPECT_EQ(meet(can, brick, {0, 5, 0.5}, -2 * up), 1.5);
  EXPECT_EQ(meet(can, ball, {0.25, 5.5, 0}, -2 * up), 2);
  EXPECT_EQ(meet(brick, can, {0, 1, -6}, 2 * far_z), 2);
  EXPECT_EQ(meet(brick, can, {0, 3.5, -6}, 2 * far_z), never) << "passes over";
}

TEST(TimeOfImpact, UnderGravityItIsTheFallsTime) {
  EXPECT_EQ(meet(brick, brick, {0.5, 7, 0}, none, -10 * up), 1);
  EXPECT_EQ(meet(can, brick, {0.5, 7, 0}, none, -10 * up), 1);
  EXPECT_EQ(meet(brick, ball, {0.25, 6.5, 0}, none, -10 * up), 1);
  EXPECT_EQ(meet(can, ball, {0.25, 6.5, 0}, none, -10 * up, 0.99), never) << "beyond the horizon";
  EXPECT_NEAR(meet(can, can, {0, 7, 0}, 10 * up, -10 * up), 1 + sqrt(2.0), 4.5e-16);
}

TEST(TimeOfImpact, EdgesCornersAndRimsAreRoundForABall) {
  // On the edge's cylinder at 3-4-5, the corner's ball at 2-3-6-7, the rim's torus at 3-4-5 around the axis.
  EXPECT_NEAR(meet(brick, ball, {0.5 + 0.3, 1 + 0.4 + 2, 0}, -up), 2, 4e-16);
  const Volume marble = Volume::sphere(0.7);
  EXPECT_NEAR(meet(brick, marble, {0.5 + 0.2, 1 + 0.3, 1.5 + 0.6 + 2}, -far_z), 2, 1e-15);
  const double s = sqrt(0.5);
  EXPECT_NEAR(meet(can, ball, {0.8 * s, 1 + 0.4 + 2, 0.8 * s}, -up), 2, 6e-16);
  EXPECT_NEAR(meet(can, ball, {0.8, 1.4 + 5, 0}, none, -10 * up), 1, 2e-16);
}

TEST(TimeOfImpact, APlaneIsMetByTheVolumesForemostPoint) {
  for (const Volume& v : {ball, can, brick}) {
    World world = two_bodies(v, ball);
    const Vec3 n(0.6, 0.8, 0);
    world.planes = {{none, n, nullopt}};
    const double reach = v.support(n);
    const FeatureTime m = time_of_impact(world, 0, 2, motion(-(reach + 5) * n, none, 10 * n), no_feature, 10);
    EXPECT_NEAR(m.time, 1, 3e-16);
    EXPECT_TRUE(is_flat(world, 0, 2, m.feature));
  }
}

TEST(TimeOfImpact, TheFaceThatIsEnteredLastGivesTheNormal) {
  const World world = two_bodies(brick, brick);
  // x is entered at t = 1, y at 2, z always.
  const FeatureTime m = time_of_impact(world, 0, 1, motion({2, 4, 0.5}, {-1, -1, 0}), no_feature, 10);
  EXPECT_EQ(m.time, 2);
  EXPECT_EQ(touch(world, 0, none, 1, {0, 2, 0.5}, m.feature).normal, up);
  // Both at once: x before y.
  const FeatureTime tie = time_of_impact(world, 0, 1, motion({2, 3, 0.5}, {-1, -1, 0}), no_feature, 10);
  EXPECT_NEAR(tie.time, 1, 3e-16);
  EXPECT_EQ(touch(world, 0, none, 1, {1, 2, 0.5}, tie.feature).normal, right);
}

TEST(TimeOfImpact, TouchingAndApproachingIsNowAndSeparatingIsNever) {
  const Volume volumes[] = {ball, can, brick};
  for (const Volume& a : volumes)
    for (const Volume& b : volumes) {
      const double reach = a.half.x() + b.half.x();

      for (double off : {0.0, -0x1p-52, -0.01}) {
        const Vec3 d = (reach + off) * right;
        EXPECT_EQ(meet(a, b, d, -1e-3 * right), 0);
        EXPECT_EQ(meet(a, b, d, 1e-3 * right), never);
        EXPECT_EQ(meet(a, b, d, none), never);
      }

      const World world = two_bodies(a, b);
      const RelativeMotion noise{reach * right, -0x1p-52 * right, none, 2, false};
      EXPECT_EQ(time_of_impact(world, 0, 1, noise, no_feature, 10).time, never)
          << "an approach within rounding is none";
    }
}

TEST(TimeOfImpact, SlidingAlongAFaceIsNoCollision) {
  EXPECT_EQ(meet(brick, brick, {0, 2, 0}, right), never);
  EXPECT_EQ(meet(brick, ball, {0, 1.5, 0}, right), never);
  EXPECT_EQ(meet(can, can, {0, 2, 0}, right), never);
  EXPECT_EQ(meet(can, brick, {0, 2, 0}, right, -10 * up), 0) << "pressed on";
}

TEST(TimeOfImpact, AFaceBeyondTheRoundEdgeIsNotMetBeforeTheWayToIt) {
  // From beside a box along its front: too near by a rounding, and approaching by a rounding of the speeds.
  const Volume box = Volume::box({0.1384421871664729, 0.24287791388904598, 0.12745924292686853});
  const Volume lid = Volume::cylinder(0.14984609735707394, 0.10311819694931741);
  for (double nearing : {0.0, 0x1p-54, 0x1p-50}) {
    const Vec3 d(-0.121, -0.1, -(box.half.z() + lid.half.x())), w(2, 2, nearing), a(10, 0, 0);
    EXPECT_GT(touch(two_bodies(box, lid), 0, none, 1, d).gap, 0.008);
    const double t = meet(box, lid, d, w, a, 0.2);
    EXPECT_GT(t, 0.02) << nearing;
  }
}

TEST(TimeOfImpact, ABallThatFallsOffABoxesFaceStrikesItsEdgeOnlyWhereItIsSlow) {
  const World world = two_bodies(brick, ball);
  const auto after = [&](double speed, uint8_t left) {
    return time_of_impact(world, 0, 1, motion({0.5, 1.5, 0}, speed * right, -10 * up), left, 10).time;
  };
  const FeatureTime rim =
      leave_feature(world, 0, 1, PrismFeature{0, 1, 0}.code(), motion({0.25, 1.5, 0}, 2 * right), 10);
  EXPECT_EQ(rim.time, 0.125);
  // On a rim of radius r it stays for speeds below sqrt(g r) = sqrt(5).
  EXPECT_EQ(after(2.2, rim.feature), 0);
  EXPECT_EQ(after(2.3, rim.feature), never);
}

TEST(TimeOfImpact, ExchangingTheTwoChangesNothing) {
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : {Kind::sphere, Kind::cylinder, Kind::box}) {
      Sampler random(3);
      for (int k = 0; k < 100; ++k) {
        const World world = pair_world(ka, kb, true, random);
        const Vec3 d = random.uniform(2, 5) * random.direction(), a = k % 2 * random.vector(5);
        const Vec3 w = -(d + random.vector(1));
        const double t = time_of_impact(world, 0, 1, motion(d, w, a), no_feature, 10).time;
        EXPECT_EQ(time_of_impact(world, 1, 0, motion(-d, -w, -a), no_feature, 10).time, t);
        // Mirrored in x as well.
        const Vec3 mirror(-1, 1, 1);
        EXPECT_EQ(
            time_of_impact(world, 0, 1, motion(d.cwiseProduct(mirror), w.cwiseProduct(mirror), a.cwiseProduct(mirror)),
                           no_feature, 10)
                .time,
            t);
      }
    }
}

TEST(TimeOfImpact, AxesMayBePermutedAsFarAsTheShapesAllow) {
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : {Kind::sphere, Kind::cylinder, Kind::box}) {
      Sampler random(4);
      for (int k = 0; k < 100; ++k) {
        World world = pair_world(ka, kb, true, random);
        const Vec3 d = random.uniform(2, 5) * random.direction(), a = k % 2 * random.vector(5);
        const Vec3 w = -(d + random.vector(0.5));
        const double t = time_of_impact(world, 0, 1, motion(d, w, a), no_feature, 10).time;

        const bool round = ka == Kind::cylinder || kb == Kind::cylinder;
        const auto permuted = [&](const Vec3& v) {
          return round ? Vec3(v.z(), v.y(), v.x()) : Vec3(v.y(), v.z(), v.x());
        };

        for (Volume& v : world.volume) v.half = permuted(v.half);
        const double u =
            time_of_impact(world, 0, 1, motion(permuted(d), permuted(w), permuted(a)), no_feature, 10).time;

        if (t == never) {
          EXPECT_EQ(u, never);
        } else {
          EXPECT_NEAR(u, t, 1e-14 * t) << name(ka) << " " << name(kb);
        }
      }
    }
}

TEST(TimeOfImpact, ScalingByPowersOfTwoKeepsTheBits) {
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(5);
      for (int k = 0; k < 100; ++k) {
        const World world = pair_world(ka, kb, false, random);
        const Vec3 d = random.uniform(2, 5) * random.direction(), a = k % 2 * random.vector(5);
        const Vec3 w = -(d + random.vector(0.5));
        const FeatureTime m = time_of_impact(world, 0, 1, motion(d, w, a), no_feature, 10);

        for (const auto& [length, time] : {pair(0x1p20, 0x1p-7), pair(0x1p-30, 0x1p11)}) {
          World scaled = world;
          scaled.volume[0].half *= length;
          for (Obstacle& o : scaled.obstacles) o.volume.half *= length;
          for (Wall& wall : scaled.walls) {
            wall.half_width *= length;
            wall.half_height *= length;
          }

          const FeatureTime n = time_of_impact(
              scaled, 0, 1, motion(length * d, length / time * w, length / time / time * a), no_feature, 10 * time);
          EXPECT_EQ(n.time, m.time * time) << name(ka) << " " << name(kb);
          EXPECT_EQ(n.feature, m.feature);
        }
      }
    }
}

TEST(TimeOfImpact, BouncedPairsAreNotHitAgainByRounding) {
  // Each pair meets and bounces, with the remaining speed along the normal scaled down to almost nothing.
  // Straight on, they never meet again; pressed together by an acceleration, they do so after the whole hop.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(6);
      int bounced = 0;
      for (int k = 0; k < 200; ++k) {
        World world = pair_world(ka, kb, false, random);
        const Vec3 d = random.uniform(2, 5) * random.direction(), w = -(d + random.vector(0.5));
        const FeatureTime m = time_of_impact(world, 0, 1, motion(d, w), no_feature, 10);
        if (m.time == never) continue;

        ++bounced;
        const Vec3 x = d + m.time * w;
        if (!world.walls.empty()) world.walls[0].center = x;
        const Touch t = touch(world, 0, none, 1, x, m.feature);
        const Vec3 along = w - w.dot(t.normal) * t.normal;

        for (double speed : {1.0, 1e-3, 1e-6, 1e-9}) {
          EXPECT_EQ(time_of_impact(world, 0, 1, motion(x, speed * t.normal + along), m.feature, 10).time, never)
              << name(ka) << " " << name(kb) << " feature " << int(m.feature) << " speed " << speed;
          const FeatureTime again =
              time_of_impact(world, 0, 1, motion(x, speed * t.normal, -10 * t.normal), m.feature, 10);
          EXPECT_NEAR(again.time / (0.2 * speed), 1, 1e-13)  // worst: 1.4e-14, at oblique patches
              << name(ka) << " " << name(kb) << " feature " << int(m.feature) << " speed " << speed;
        }
      }

      EXPECT_GT(bounced, 20) << name(ka) << " " << name(kb);
    }
}

TEST(TimeOfImpact, PairsARoundingApartThatApproachMeetAtOnce) {
  // Bodies that touch and have just been struck by others are in this state. The remaining path is shorter than
  // positions resolve, and must not shrink in ever smaller steps at any feature.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(9);
      int touched = 0;
      for (int k = 0; k < 400; ++k) {
        World world = pair_world(ka, kb, false, random);
        const Vec3 d = random.uniform(2, 5) * random.direction(), w = -(d + random.vector(0.5));
        const FeatureTime m = time_of_impact(world, 0, 1, motion(d, w), no_feature, 10);
        if (m.time == never) continue;

        ++touched;
        const double off = random.uniform(-1e-15, 1e-15);
        const Vec3 x = d + (m.time + off) * w;
        if (!world.walls.empty()) world.walls[0].center = x;
        const Touch there = touch(world, 0, none, 1, x, m.feature);

        const Vec3 fall(1, -10, 2);
        const double speed = -there.normal.dot(w);
        if (speed < 0.1 * w.norm()) continue;
        const FeatureTime now = time_of_impact(world, 0, 1, motion(x, w, fall), no_feature, 10);
        EXPECT_LE(now.time * speed, 1e-14) << name(ka) << " " << name(kb) << " feature " << int(m.feature);
      }

      EXPECT_GT(touched, 20) << name(ka) << " " << name(kb);
    }
}

TEST(TimeOfImpact, GrazingARoundingIsAHitOrAMissByItsDepth) {
  // Past a fixed edge, corner, rim or side at a depth of 2^-k of the ball's radius, against long double.
  for (Kind kb : {Kind::cylinder, Kind::box}) {
    Sampler random(8);
    double worst[3] = {};
    int hits = 0;
    for (int n = 0; n < 600; ++n) {
      World world = pair_world(Kind::sphere, kb, false, random, 0.1);
      const Thing core = of(world, 1);
      const Vec3 from = random.uniform(3, 5) * random.direction();
      const Vec3 beside = 1.5 * random.direction();
      const Vec3 v = beside - from;  // the ball's; it passes `beside` at t = 1

      const auto distance_to_core = [&](long double t) {
        const long double x = from.x() + t * v.x(), y = from.y() + t * v.y(), z = from.z() + t * v.z();
        long double e[3] = {x, y, z}, sum = 0;
        if (kb == Kind::cylinder) {
          const long double out = std::max(sqrt(x * x + z * z) - core.half.x(), 0.0L);
          const long double over = std::max(std::abs(y) - static_cast<long double>(core.half.y()), 0.0L);
          return sqrt(out * out + over * over);
        }

        for (int k = 0; k < 3; ++k) {
          const long double out = std::max(std::abs(e[k]) - static_cast<long double>(core.half[k]), 0.0L);
          sum += out * out;
        }
        return sqrt(sum);
      };

      // The least distance, by thirds.
      long double low = 0, high = 4;
      for (int k = 0; k < 300; ++k) {
        const long double p = low + (high - low) / 3, q = high - (high - low) / 3;
        if (distance_to_core(p) < distance_to_core(q)) {
          high = q;
        } else {
          low = p;
        }
      }

      const double least = static_cast<double>(distance_to_core(low));
      if (least < 0.1 || low > 3.9L) continue;
      ++hits;

      const double depths[3] = {0x1p-10, 0x1p-20, 0x1p-33};
      for (int k = 0; k < 3; ++k) {
        world.volume[0] = Volume::sphere(least * (1 + depths[k]));
        const double r = world.volume[0].half.x();
        const double t = time_of_impact(world, 0, 1, motion(-from, -v), no_feature, 10).time;
        ASSERT_LT(t, never) << name(kb) << " depth " << depths[k];

        // The time by bisection: the distance is the radius there.
        long double a = 0, b = low;
        for (int step = 0; step < 200; ++step) {
          const long double middle = (a + b) / 2;
          (distance_to_core(middle) > r ? a : b) = middle;
        }
        worst[k] = std::max(worst[k], std::abs(static_cast<double>((t - a) / a)));

        world.volume[0] = Volume::sphere(least * (1 - depths[k]));
        EXPECT_EQ(time_of_impact(world, 0, 1, motion(-from, -v), no_feature, 10).time, never) << name(kb) << depths[k];
      }
    }

    printf("%s: %d, relative error at depths 2^-10, 2^-20, 2^-33: %.2g %.2g %.2g\n", name(kb), hits, worst[0], worst[1],
           worst[2]);

    EXPECT_GT(hits, 100);
    EXPECT_LT(worst[0], 2e-14);
    EXPECT_LT(worst[1], 1e-12);
    EXPECT_LT(worst[2], 3e-11);
  }
}

}  // namespace
}  // namespace carom
