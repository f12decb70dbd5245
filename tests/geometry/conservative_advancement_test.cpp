// No contact is missed or invented, for every pair of kinds. Paths are sampled densely. A plane between the two volumes
// and a point that belongs to both verify each contact.
#include <gtest/gtest.h>

#include "geometry/conservative_advancement.h"
#include "physics/world.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using namespace by_hand;

struct Tally {
  int paths = 0, hits = 0, missed = 0, invented = 0;
  double worst = 0;  // of a contact's gap, over the pair's size
};

struct Path {
  Vec3 d, w, a;
  Vec3 at(double t) const { return d + t * w + 0.5 * t * t * a; }
  Vec3 speed(double t) const { return w + t * a; }
};

void check(const World& world, const Path& path, double horizon, Tally& tally, bool print = false) {
  const Thing a = of(world, 0), b = of(world, 1);
  const double size = a.half.sum() + b.half.sum();
  const FeatureTime m =
      time_of_impact(world, 0, 1, {path.d, path.w, path.a, path.w.cwiseAbs().sum(), false}, no_feature, horizon);
  ++tally.paths;

  // Before, not even the cores overlap.
  const double end = std::min(m.time, horizon);
  const Thing core_a = shrunk(a, 1e-7), core_b = shrunk(b, 1e-7);
  for (int k = 0; k < 300; ++k) {
    const double t = end * k / 300;
    if (distance(core_a, core_b, path.at(t), 1e-12 * size) <= 1e-12 * size && t < end * (1 - 1e-6)) {
      ++tally.missed;
      if (print) printf("missed: hit %.17g, overlap at %.17g\n", m.time, t);
      break;
    }
  }

  if (m.time == never) return;
  ++tally.hits;

  // The contact's own point and normal fit both.
  const Vec3 d = path.at(m.time);
  World there = world;
  if (!there.walls.empty()) there.walls[0].center = d;
  const Touch touched = touch(there, 0, Vec3::Zero(), 1, d, m.feature);
  const double gap = touched.normal.dot(d) - a.support(touched.normal) - b.support(touched.normal);
  const double off_a = (touched.point - a.nearest(touched.point)).norm();
  const double off_b = (touched.point - d - b.nearest(touched.point - d)).norm();
  const double reach = size + path.d.norm() + path.w.norm() * m.time + path.a.norm() * m.time * m.time;
  const double error = std::max({std::abs(gap), off_a, off_b, std::abs(touched.gap)}) / reach;

  tally.worst = std::max(tally.worst, error);
  const bool approaching = touched.normal.dot(path.speed(m.time)) < 0;
  if (error > 1e-12 || !approaching) {
    ++tally.invented;
    if (print)
      printf("invented: t %.17g feature %d gap %.3g touch gap %.3g off a %.3g off b %.3g approach %g\n", m.time,
             m.feature, gap, touched.gap, off_a, off_b, touched.normal.dot(path.speed(m.time)));
  }
}

/// A path from outside, aimed so that the two come close.
Path random_path(const World& world, Sampler& random, bool curved, double& horizon) {
  const Thing a = of(world, 0), b = of(world, 1);
  const double size = a.half.norm() + b.half.norm();
  Path path;
  path.d = (size * random.uniform(1.01, 4)) * random.direction();
  path.a = curved ? Vec3(random.uniform(0.1, 10) * random.direction()) : Vec3::Zero();
  const double flight = random.log_uniform(0.1, 10);
  const Vec3 aim = random.vector(0.8 * size);
  path.w = (aim - path.d) / flight - 0.5 * flight * path.a;
  horizon = 3 * flight;
  return path;
}

TEST(TimeOfImpact, NoContactIsMissedAndNoneInvented) {
  SLOW_WITH_SANITIZERS();
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds)
      for (bool curved : {false, true}) {
        Sampler random(static_cast<unsigned>(100 * static_cast<int>(ka) + 10 * static_cast<int>(kb) + curved));
        Tally tally;
        for (int k = 0; k < 150; ++k) {
          const World world = pair_world(ka, kb, k % 2 == 0, random, 1e-3 * (k % 3 == 0 ? 1 : 100));
          double horizon;
          const Path path = random_path(world, random, curved, horizon);
          check(world, path, horizon, tally);
        }

        printf("%-9s %-13s %s: %d paths, %d hits, %d missed, %d invented, worst %.2g\n", name(ka), name(kb),
               curved ? "curved  " : "straight", tally.paths, tally.hits, tally.missed, tally.invented, tally.worst);
        EXPECT_EQ(tally.missed, 0) << name(ka) << name(kb) << curved;
        EXPECT_EQ(tally.invented, 0) << name(ka) << name(kb) << curved;
        EXPECT_GT(tally.hits, 10);
        // Spheres that meet spheres or walls on curved paths use only the quartic.
        const bool quartic = ka == Kind::sphere && kb != Kind::cylinder && kb != Kind::box && curved;
        EXPECT_LT(tally.worst, quartic ? 1e-12 : 1e-14);
      }
}

TEST(TimeOfImpact, NoContactIsMissedInChainsOfBounces) {
  SLOW_WITH_SANITIZERS();
  // After its first contact a pair is pressed together and bounces, with restitutions down to 1e-4, over faces, edges
  // and rims.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(static_cast<unsigned>(1000 + 10 * static_cast<int>(ka) + static_cast<int>(kb)));
      Tally tally;
      for (int k = 0; k < 100; ++k) {
        World world = pair_world(ka, kb, k % 2 == 0, random, k % 3 == 0 ? 1e-3 : 0.1);
        const Thing a = of(world, 0), b = of(world, 1);
        const Thing core_a = shrunk(a, 1e-6), core_b = shrunk(b, 1e-6);
        const double size = a.half.sum() + b.half.sum();

        double horizon;
        Path path = random_path(world, random, false, horizon);
        uint8_t left = no_feature;
        for (int bounce = 0; bounce < 9; ++bounce) {
          const RelativeMotion motion{path.d, path.w, path.a, path.w.cwiseAbs().sum(), false};
          const FeatureTime m = time_of_impact(world, 0, 1, motion, left, horizon);
          ++tally.paths;

          // Nothing overlaps before.
          const double end = std::min(m.time, horizon);
          for (int i = 0; i < 60; ++i)
            if (distance(core_a, core_b, path.at(end * i / 60), 1e-12 * size) <= 1e-12 * size) {
              ++tally.missed;
              break;
            }

          if (m.time == never) break;
          ++tally.hits;
          const Vec3 d = path.at(m.time), v = path.speed(m.time);
          if (!world.walls.empty()) world.walls[0].center = d;
          const Touch t = touch(world, 0, Vec3::Zero(), 1, d, m.feature);
          const double gap = t.normal.dot(d) - a.support(t.normal) - b.support(t.normal);
          const double reach = size + path.d.norm() + path.w.norm() * m.time + path.a.norm() * m.time * m.time;
          tally.worst = std::max(tally.worst, std::max(std::abs(gap), std::abs(t.gap)) / reach);
          if (m.time > 0 && !(t.normal.dot(v) < 0)) ++tally.invented;

          // It bounces.
          if (bounce == 0) path.a = -random.log_uniform(0.1, 10) * (t.normal + random.vector(k % 4 < 2 ? 0.2 : 1));
          const double restitution[] = {1, 0.3, 1e-4};
          path = {d, v - (1 + restitution[bounce % 3]) * v.dot(t.normal) * t.normal, path.a};
          left = m.feature;
          horizon = 5;
        }
      }

      EXPECT_EQ(tally.missed, 0) << name(ka) << " " << name(kb);
      EXPECT_EQ(tally.invented, 0) << name(ka) << " " << name(kb);
      EXPECT_GT(tally.hits, 30) << name(ka) << " " << name(kb);
      EXPECT_LT(tally.worst, ka == Kind::sphere ? 1e-12 : 1e-14) << name(ka) << " " << name(kb);  // 5e-13, 2e-15
    }
}

TEST(ConservativeAdvancement, APathAlmostAlongAnAxisMeetsLikeAnyOther) {
  SLOW_WITH_SANITIZERS();
  // The small part of the position resolves times that the large part is too coarse for.
  for (Kind ka : {Kind::sphere, Kind::cylinder, Kind::box})
    for (Kind kb : all_kinds) {
      Sampler random(static_cast<unsigned>(3000 + 10 * static_cast<int>(ka) + static_cast<int>(kb)));
      Tally tally;
      for (int k = 0; k < 150; ++k) {
        const World world = pair_world(ka, kb, k % 2 == 0, random, 0.1);
        const Thing a = of(world, 0), b = of(world, 1);
        const int axis = k % 3, other = (k + 1 + k / 3 % 2) % 3;

        // Almost along one axis, with a small part along another.
        Path path{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        const double reach = a.support(Vec3::Unit(axis)) + b.support(Vec3::Unit(axis));
        path.d[axis] = reach * (1 + random.log_uniform(1e-10, 1e-2));
        path.w[axis] = -random.log_uniform(1e-3, 1e-1);
        path.d[other] = 1e-3 * reach * random.log_uniform(1e-12, 1);
        path.w[other] = 0.3 * random.uniform(-1, 1) * path.w[axis];

        check(world, path, 0.5 * reach / -path.w[axis], tally);
      }

      EXPECT_EQ(tally.missed, 0) << name(ka) << " " << name(kb);
      EXPECT_EQ(tally.invented, 0) << name(ka) << " " << name(kb);
      EXPECT_GT(tally.hits, 120) << name(ka) << " " << name(kb);
    }
}

TEST(ConservativeAdvancement, AGapSmallerThanThePositionsResolveIsMet) {
  SLOW_WITH_SANITIZERS();
  // A ball on its way to a cylinder's rim, 1.5e-16 m from it: its position does not change before the gap is closed.
  World world;
  world.mass = {1, 1};
  world.restitution = {1, 1};
  world.volume = {{Shape::cylinder, Vec3(0.075044022308829575, 0.050663637425331483, 0.075044022308829575)},
                  Volume::sphere(0.11079129007174113)};
  for (const Volume& v : world.volume) world.radius.push_back(v.reach());
  const Vec3 d(-0x1.45045fdbd18d2p-3, -0x1.f505e83252fep-4, -0x1.0c62378514edp-6);
  const Vec3 w(-0x1.6a2c3cc0d9176p+0, 0x1.0c0275dcc06dbp+2, -0x1.6dacd5e43692ap-2), a(0, 0x1.17607721b7d0cp+3, 0);
  EXPECT_LT(time_of_impact(world, 0, 1, {d, w, a, 20, false}, no_feature, 1).time, 1e-15);
}

TEST(ConservativeAdvancement, APathThatLeavesARoundedEdgeAsItBendsIsFollowedToTheFaceBeyond) {
  SLOW_WITH_SANITIZERS();
  // A ball that touches a box's edge leaves it with the edge's own curvature. The gap grows with the third power of
  // time, and the ball dips below the box and comes back to its bottom.
  for (const double pull : {0.5, 1.0, 3.0})
    for (const double push : {0.0, 1e-12, 1e-9}) {
      const double r = 0.15, half = 0.1, out = r * sqrt(0.5), speed = 1;
      const Vec3 along = Vec3(1, -1, 0) * sqrt(0.5), normal = Vec3(-1, -1, 0) * sqrt(0.5);

      World world;
      world.mass = {1, 1};
      world.restitution = {1, 1};
      world.volume = {Volume::box({8, 2 * half, 2 * half}), Volume::sphere(r)};
      for (const Volume& v : world.volume) world.radius.push_back(v.reach());

      const Vec3 d(-4 - out, -half - out, 0), w = speed * along;
      const Vec3 a = pull * along - (1 - push) * speed * speed / r * normal;

      // When it comes back to the bottom.
      const double room = d.y() + half + r;  // m, above the plane of the bottom
      const double time = (-w.y() + sqrt(w.y() * w.y() - 2 * a.y() * room)) / a.y();

      const FeatureTime found = time_of_impact(world, 0, 1, {d, w, a, 4, false}, no_feature, 10);
      EXPECT_NEAR(found.time, time, 1e-13) << pull << ' ' << push;
    }
}

/// A ball slides up the side of a cylinder, in the tangent plane: z^2 / 2 R from it, far below what places resolve. It
/// is pressed on by nearly nothing.
TEST(ConservativeAdvancement, WhatHardlyPressesOnATangentIsContactAtOnce) {
  World world;
  world.mass = {1, 1};
  world.restitution = {1, 1};
  world.volume = {Volume::sphere(0.007), Volume::cylinder(0.011, 0.02)};
  for (const Volume& v : world.volume) world.radius.push_back(v.reach());

  const double z = 0x1p-58, reach = 0.007 + 0.011, pull = 4e-10;
  for (const double along : {-0.2, 0.2}) {
    const RelativeMotion motion{{-reach, 0.004, z}, {0, along, 0}, {pull, 0, 0}, 0.2, false};
    EXPECT_NEAR(time_of_impact(world, 0, 1, motion, no_feature, 0.005).time, z / sqrt(reach * pull), 1e-15);
  }
}

TEST(ConservativeAdvancement, APathAlongACurvedSurfaceThatTurnsAwayMeetsNothingLater) {
  SLOW_WITH_SANITIZERS();
  // A cylinder's side touches a box's edge, except for rounding, and approaches it no faster than rounding. The plane
  // through the edge lies a while ahead, and the surface has left it by then.
  World world;
  world.mass = {1, 1};
  world.restitution = {1, 1};
  world.volume = {Volume::cylinder(0.136, 0.2), Volume::box({0.2, 0.2, 0.2})};
  for (const Volume& v : world.volume) world.radius.push_back(v.reach());

  Sampler random(11);
  int met = 0;
  for (int k = 0; k < 4000; ++k) {
    const double angle = random.uniform(0.2, 1.3), gap = random.log_uniform(1e-18, 1e-15);
    const Vec3 out(std::cos(angle), 0, std::sin(angle)), along(std::sin(angle), 0, -std::cos(angle));
    const Vec3 d = Vec3(0.1, 0.01, 0.1) + (0.136 + gap) * out;
    const Vec3 w = 0.3 * along - random.log_uniform(1e-16, 1e-11) * out;
    const FeatureTime found = time_of_impact(world, 0, 1, {d, w, Vec3::Zero(), 1, false}, no_feature, 0.3);
    if (found.time == never) continue;
    ++met;
    EXPECT_LT(touch(world, 0, Vec3::Zero(), 1, d + found.time * w, found.feature).gap, 1e-14) << k;
  }

  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace carom
