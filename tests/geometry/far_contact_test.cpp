// Small spheres that meet on curved paths from afar, against quadruple precision. At the contact the gap is zero, and
// it is never less before, to the rounding of the path length. The quartic's own coefficients have an error of the
// square of that length over the radius, here 1e5 times as much.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using by_hand::Sampler;
__extension__ typedef __float128 Quad;

Quad root(Quad x) {
  Quad r = sqrt(static_cast<double>(x));
  for (int k = 0; k < 4 && r > 0; ++k) r = (r + x / r) / 2;
  return r;
}

/// A sphere that comes near another, or a point, after one second; a third of the paths hit it, the others graze.
struct Throw {
  RelativeMotion m;
  double s, size;  // m; of the numbers that the gap is made of

  Throw(Sampler& random, bool just_separated) {
    const double far = random.log_uniform(1, 256);
    s = random.log_uniform(1e-3, 1);
    m.just_separated = just_separated;
    const Vec3 direction = random.direction();

    if (just_separated) {  // up and down again
      m.d = s * direction;
      m.w = far * random.direction();
      if (m.w.dot(m.d) < 0) m.w = -m.w;
      m.a = -2 * m.w + random.vector(2 * s);
    } else {
      m.a = random.vector(0.5 * far * random.log_uniform(0.01, 2));
      m.w = far * direction;
      const Vec3 aside = random.direction().cross(m.w + m.a).normalized();
      const bool grazes = random.uniform(0, 3) > 1;
      const double miss = grazes ? 1 + random.uniform(-1, 1) * random.log_uniform(0x1p-45, 1) : random.uniform(0, 1.2);
      m.d = s * miss * aside - (m.w + 0.5 * m.a);
    }

    m.speeds = m.w.cwiseAbs().sum();
    size = m.d.norm() + s + m.w.norm() + 0.5 * m.a.norm();
  }

  double gap(double t) const {
    Quad square = 0, start = 0;
    for (int k = 0; k < 3; ++k) {
      const Quad p = Quad(m.d[k]) + t * (Quad(m.w[k]) + t * (Quad(m.a[k]) / 2));
      square += p * p;
      start += Quad(m.d[k]) * m.d[k];
    }
    return static_cast<double>(root(square) - (m.just_separated ? root(start) : s));
  }

  /// The least gap on a stretch of the path on which it first falls, then rises.
  double least(double from, double to) const {
    for (int k = 0; k < 60; ++k) {
      const double a = from + 0.4 * (to - from), b = from + 0.6 * (to - from);
      (gap(a) < gap(b) ? to : from) = gap(a) < gap(b) ? b : a;
    }
    return gap(0.5 * (from + to));
  }
};

TEST(FarContact, SmallSpheresMeetToTheRoundingOfTheWay) {
  SLOW_WITH_SANITIZERS();
  Sampler random(7);
  int hits = 0, misses = 0;
  double worst = 0, deepest = 0;  // in units of the way's rounding
  for (int k = 0; k < 6000; ++k) {
    const Throw ball(random, k % 3 == 0);
    const double unit = 0x1p-53 * ball.size, t = sphere_contact_time(ball.m, ball.s, 2);
    if (t < never) worst = std::max(worst, std::abs(ball.gap(t)) / unit);
    ++(t < never ? hits : misses);

    // Between, the two come no nearer.
    double end = std::min(t, 2.0), nearest = 0.5 * end;
    for (double u = nearest; u <= end; u += end / 64)
      if (ball.gap(u) < ball.gap(nearest)) nearest = u;
    deepest = std::max(deepest, -ball.least(nearest - end / 64, std::min(nearest + end / 64, end)) / unit);
  }

  printf("%d hits, %d misses, gap at contact %.2g, overlap before %.2g\n", hits, misses, worst, deepest);
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 1000);
  EXPECT_LE(worst, 6);
  EXPECT_LE(deepest, 6);
}

TEST(FarContact, ASmallBallMeetsAWallsEdgesAndCornersToTheRoundingOfTheWay) {
  SLOW_WITH_SANITIZERS();
  Sampler random(8);
  const Wall wall{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1, {}};
  int edges = 0, corners = 0;
  double worst = 0;

  for (int k = 0; k < 20000; ++k) {
    const double radius = random.log_uniform(1e-3, 1e-1);
    const Vec3 v = random.uniform(1, 10) * random.direction(), a(0, -random.log_uniform(1e-2, 10), 0);
    const Vec3 target(1, k % 2 == 0 ? 1 : random.uniform(-1, 1), 0);
    const Vec3 x = target + random.vector(radius) - (v + 0.5 * a);
    const FeatureTime c = wall_contact_time(wall, x, v, a, radius, no_feature, 3);
    if (c.feature == no_feature || c.feature < wall_edges) continue;
    ++(c.feature < wall_corners ? edges : corners);

    // By the reference, the nearest point of the wall is a radius away.
    Quad square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Quad p = Quad(x[axis]) + c.time * (Quad(v[axis]) + c.time * (Quad(a[axis]) / 2));
      if (axis < 2) p = p > 1 ? p - 1 : p < -1 ? p + 1 : Quad(0);
      square += p * p;
    }
    const double size = x.norm() + v.norm() + a.norm() + 1;
    worst = std::max(worst, std::abs(static_cast<double>(root(square) - radius)) / (0x1p-53 * size));
  }

  printf("%d edges, %d corners, gap at contact %.2g\n", edges, corners, worst);
  EXPECT_GT(edges, 1000);
  EXPECT_GT(corners, 100);
  EXPECT_LE(worst, 6);
}

}  // namespace
}  // namespace carom
