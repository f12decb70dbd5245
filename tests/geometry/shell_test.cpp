// Balls and shells: gaps, curvature and times of impact, against points along the path.
#include "geometry/shell.h"

#include <gtest/gtest.h>

#include "geometry/path_time_of_impact.h"
#include "geometry/touch.h"
#include "geometry/volumes_by_hand.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr Hollow all_hollows[] = {Hollow::whole, Hollow::lower_half, Hollow::upper_half, Hollow::side};

/// A ball, body 0, and a shell, entity 1.
World with_shell(Hollow hollow, double radius, double height, double r, const Vec3& center = Vec3::Zero()) {
  World world;
  world.mass = {1};
  world.radius = {r};
  world.restitution = {1};
  const Volume volume = hollow == Hollow::side ? Volume::cylinder(radius, height) : Volume::sphere(radius);
  world.obstacles.push_back({center, volume, nullopt, hollow});
  return world;
}

/// The distance of p from points that are spread over the shell, less r.
double gap_by_points(const Obstacle& shell, const Vec3& p, double r) {
  const double radius = shell.volume.half.x();
  double least = infinity;
  // The nearest point lies in the plane through p and the axis.
  const double rho = hypot(p.x(), p.z());

  for (int k = 0; k <= 20000; ++k) {
    const double share = k / 20000.0;
    double out, up;
    if (shell.hollow == Hollow::side) {
      out = radius, up = (2 * share - 1) * shell.volume.half.y();
    } else {
      const double low = shell.hollow == Hollow::upper_half ? 0 : -M_PI / 2;
      const double high = shell.hollow == Hollow::lower_half ? 0 : M_PI / 2;
      const double angle = low + share * (high - low);
      out = radius * std::cos(angle), up = radius * std::sin(angle);
    }

    least = min(least, hypot(rho - out, p.y() - up));
  }
  return least - r;
}

TEST(Shell, TheGapIsTheDistanceOfTheNearestPointOfItsSurface) {
  Sampler sampler(3);
  for (const Hollow hollow : all_hollows)
    for (int k = 0; k < 30; ++k) {
      const World world = with_shell(hollow, 1, 1.6, 0.1, {0.3, -0.2, 0.5});
      const Vec3 x = world.obstacles[0].center + sampler.vector(2);
      const Touch there = touch(world, 0, x, 1, world.obstacles[0].center);
      const Vec3 p = x - world.obstacles[0].center;
      EXPECT_NEAR(there.gap, gap_by_points(world.obstacles[0], p, 0.1), 5e-7) << int(hollow);
      EXPECT_NEAR(there.normal.norm(), 1, 1e-15);
      EXPECT_LT((there.point - x - 0.1 * there.normal).norm(), 1e-15);
      // The other end of the gap lies on the shell.
      EXPECT_NEAR(Shell(world.obstacles[0]).distance(p + (0.1 + there.gap) * there.normal), 0, 1e-14);
    }
}

TEST(Shell, SmallGapsAreAsExactAsThePositions) {
  for (const double gap : {1e-3, 1e-7, 1e-11, 1e-14}) {
    const World world = with_shell(Hollow::whole, 1, 0, 0.1);
    // 0.9 is rounded too.
    EXPECT_NEAR(touch(world, 0, {1 - 0.1 - gap, 0, 0}, 1, {0, 0, 0}).gap, (1 - 0.1) - (1 - 0.1 - gap), 1e-17);
  }
}

TEST(Shell, BendingIsTheSecondDerivativeOfTheGap) {
  Sampler sampler(4);
  for (const Hollow hollow : all_hollows)
    for (int k = 0; k < 40; ++k) {
      const World world = with_shell(hollow, 1, 1.6, 0.1);
      const Vec3 x = sampler.vector(2), w = sampler.vector(1), none = Vec3::Zero();
      const Touch there = touch(world, 0, x, 1, none);
      if (there.gap < 0.05 || there.gap > 0.5) continue;

      const double h = 1e-4;
      const auto gap = [&](double t) { return touch(world, 0, x, 1, t * w, there.feature).gap; };
      const double difference = (gap(h) - 2 * gap(0) + gap(-h)) / (h * h);
      EXPECT_NEAR(bending(world, 0, x, 1, none, there, w), difference, 2e-6 * max(1.0, std::abs(difference)))
          << int(hollow) << " " << int(there.feature);
    }
}

/// The first contact on a path by small steps: from a gap above zero to one below `deep`.
double first_by_steps(const World& world, const auto& place, double horizon, double deep) {
  for (int k = 1; k <= 4000; ++k) {
    const double t = horizon * k / 4000;
    if (touch(world, 0, place(t), 1, world.obstacles[0].center).gap < -deep) return t;
  }
  return never;
}

/// Compares the time of impact on a path with a walk along it.
void compare(const World& world, const auto& place, FeatureTime found, double horizon, int& hits) {
  const Vec3& center = world.obstacles[0].center;
  const double walked = first_by_steps(world, place, horizon, 1e-9);
  if (found.time == never) {
    EXPECT_EQ(walked, never);
    return;
  }

  ++hits;
  EXPECT_LE(found.time, walked) << "passed through";
  const Touch there = touch(world, 0, place(found.time), 1, center, found.feature);
  EXPECT_NEAR(there.gap, 0, 1e-13);
  EXPECT_NEAR(touch(world, 0, place(found.time), 1, center).gap, 0, 1e-13) << "at another part of the shell";
  for (int k = 1; k < 200; ++k)
    EXPECT_GT(touch(world, 0, place(found.time * k / 200), 1, center).gap, -1e-13) << "earlier";
}

TEST(Shell, NoContactIsMissedOnParabolas) {
  Sampler sampler(5);
  int hits = 0, rims = 0;
  for (const Hollow hollow : all_hollows)
    for (int k = 0; k < 400; ++k) {
      const double r = sampler.log_uniform(0.02, 0.6);
      const World world = with_shell(hollow, 1, 1.6, r, 0.1 * sampler.vector(1));
      const Vec3 x = sampler.vector(2), v = sampler.vector(3), a = k % 3 == 0 ? Vec3(0, 0, 0) : sampler.vector(6);
      const Vec3& center = world.obstacles[0].center;
      if (touch(world, 0, x, 1, center).gap < 0.001) continue;

      const double horizon = 2;
      const FeatureTime found = time_of_impact(world, 0, 1, {center - x, -v, -a, v.norm(), false}, no_feature, horizon);
      compare(
          world, [&](double t) { return Vec3(x + t * (v + 0.5 * t * a)); }, found, horizon, hits);
      rims += found.feature == shell_low_rim || found.feature == shell_high_rim;
    }
  EXPECT_GT(hits, 300);
  EXPECT_GT(rims, 40);
}

TEST(Shell, NoContactIsMissedOnPolynomialsAndUnderDrag) {
  Sampler sampler(6);
  int hits = 0;
  for (const Hollow hollow : all_hollows)
    for (int k = 0; k < 200; ++k) {
      const World world = with_shell(hollow, 1, 1.6, 0.2, 0.1 * sampler.vector(1));
      const Vec3& center = world.obstacles[0].center;
      const Vec3 x = sampler.vector(1.6);
      if (touch(world, 0, x, 1, center).gap < 0.001) continue;

      PolynomialPath::Terms terms;
      double size = 3;
      for (Vec3& term : terms) term = sampler.vector(size *= 0.6);
      PolynomialPath::Terms apart = terms;
      for (Vec3& term : apart) term = -term;
      compare(
          world, [&](double t) { return Vec3(x + PolynomialPath::value(terms, t / 2)); },
          time_of_impact(world, 0, x, 1, center, apart, 2, 3, no_feature, 2), 2, hits);

      const FadingPath path{x, sampler.vector(6), sampler.vector(20), sampler.log_uniform(0.1, 100)};
      compare(
          world, [&](double t) { return path.position(t); },
          time_of_impact(world, 0, path, 1, {center, Vec3::Zero(), Vec3::Zero(), 0}, 6, no_feature, 2), 2, hits);
    }
  EXPECT_GT(hits, 350);
}

TEST(Shell, ABallThatFallsOntoARimMeetsItInClosedForm) {
  // At a distance d from the rim's circle, seen from above, the centre is sqrt(r^2 - d^2) higher than the rim.
  for (const double d : {-0.15, -0.05, 0.0, 0.1, 0.19})
    for (const Hollow hollow : {Hollow::lower_half, Hollow::side}) {
      const World world = with_shell(hollow, 1, 1, 0.2);
      const double rim = hollow == Hollow::side ? 0.5 : 0;
      const Vec3 x(0.6 * (1 + d), rim + 2, 0.8 * (1 + d));
      const FeatureTime found = time_of_impact(world, 0, 1, {-x, {0, 0, 0}, {0, 10, 0}, 0, false}, no_feature, 9);
      EXPECT_NEAR(found.time, sqrt(2 * (2 - sqrt(0.04 - d * d)) / 10), 1e-15) << d;
      EXPECT_EQ(found.feature, shell_high_rim);
    }
}

TEST(Shell, ABallPassesAnOpeningThatIsWideEnough) {
  const World world = with_shell(Hollow::side, 1, 2, 0.25);
  for (const double x : {0.0, 0.5, 0.7499}) {
    const RelativeMotion fall{{-x, -5, 0}, {0, 3, 0}, {0, 0, 0}, 3, false};
    EXPECT_EQ(time_of_impact(world, 0, 1, fall, no_feature, 99).time, never) << x;
  }
}

TEST(Shell, ASlidingBallLeavesForTheRimAndTheRimForASide) {
  const World world = with_shell(Hollow::side, 1, 2, 0.25);
  // Up along the inside, from the middle to the rim.
  const FeatureTime rim = leave_feature(world, 0, 1, shell_inner, {{-0.75, 0, 0}, {0, -2, 0}, {0, 0, 0}, 2, true}, 9);
  EXPECT_EQ(rim.time, 0.5);
  EXPECT_EQ(rim.feature, shell_high_rim);
  // Down from the rim, outside.
  const FeatureTime out =
      leave_feature(world, 0, 1, shell_high_rim, {{-1.2, -1.2, 0}, {0, 0.5, 0}, {0, 0, 0}, 1, true}, 9);
  EXPECT_NEAR(out.time, 0.4, 1e-15);
  EXPECT_EQ(out.feature, shell_outer);
}

TEST(Shell, ABallThatHasJustBouncedComesBackAfterTheWholeChord) {
  const World world = with_shell(Hollow::whole, 1.25, 0, 0.25);
  for (double angle = 1; angle > 1e-8; angle /= 10) {
    const Vec3 inward(-std::cos(angle), std::sin(angle), 0);
    const FeatureTime next = time_of_impact(world, 0, 1, {{-1, 0, 0}, -inward, {0, 0, 0}, 1, true}, shell_inner, 1e9);
    EXPECT_NEAR(next.time / (2 * std::cos(angle)), 1, 1e-15) << angle;
  }
}

}  // namespace
}  // namespace carom
