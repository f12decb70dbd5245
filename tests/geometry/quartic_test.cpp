// A ball under gravity and a fixed ball: the families of scenarios in which textbook quartics fail, against quadruple
// precision. Bounds: what the derivative cascade reaches in the reference table quartic.json, row by row.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "std.h"
#include "volumes_by_hand.h"

namespace carom {
namespace {

using by_hand::Sampler;
__extension__ typedef __float128 Quad;
using Coefficients = vector<Quad>;  // ascending

Quad value(const Coefficients& f, Quad t) {
  Quad sum = 0;
  for (size_t k = f.size(); k-- > 0;) sum = sum * t + f[k];
  return sum;
}

/// All sign changes in (0, end), by bisection between the roots of the derivative.
vector<Quad> roots(const Coefficients& f, Quad end) {
  if (f.size() < 2) return {};
  Coefficients slope;
  for (size_t k = 1; k < f.size(); ++k) slope.push_back(static_cast<Quad>(static_cast<double>(k)) * f[k]);

  vector<Quad> corners = roots(slope, end), found;
  corners.insert(corners.begin(), 0);
  corners.push_back(end);

  for (size_t k = 0; k + 1 < corners.size(); ++k) {
    Quad low = corners[k], high = corners[k + 1];
    const bool positive = value(f, low) > 0;
    if (positive == (value(f, high) > 0)) continue;
    for (int step = 0; step < 160; ++step) {
      const Quad middle = (low + high) / 2;
      ((value(f, middle) > 0) == positive ? low : high) = middle;
    }
    found.push_back(low);
  }

  return found;
}

Quad dot(const Vec3& a, const Vec3& b) {
  return Quad(a.x()) * b.x() + Quad(a.y()) * b.y() + Quad(a.z()) * b.z();
}

/// The first descent through zero of |d + w t + a t^2/2|^2 - s^2; -1: none. `left`: t = 0 is divided out.
Quad reference(const RelativeMotion& m, double s, bool left, double end) {
  Coefficients f{dot(m.d, m.d) - Quad(s) * s, 2 * dot(m.d, m.w), dot(m.w, m.w) + dot(m.d, m.a), dot(m.w, m.a),
                 dot(m.a, m.a) / 4};
  if (left) f.erase(f.begin());
  for (Quad t : roots(f, end)) {
    Quad slope = 0;
    for (size_t k = f.size() - 1; k > 0; --k) slope = slope * t + static_cast<Quad>(static_cast<double>(k)) * f[k];
    if (slope < 0) return t;
  }
  return -1;
}

struct Scenario {
  RelativeMotion motion;
  double s;
};

/// A ball thrown so that it comes near the fixed one after about `flight` seconds.
Scenario thrown(Sampler& random, double g, double flight, double spread) {
  const double s = 1;
  RelativeMotion m;
  m.d = random.uniform(1.5, 5) * random.direction();
  m.a = Vec3(0, g, 0);  // the fixed ball's seen from the other
  m.w = (spread * random.vector(s) - m.d) / flight - 0.5 * flight * m.a;
  m.speeds = m.w.cwiseAbs().sum();
  m.just_separated = false;
  return {m, s};
}

Scenario scenario(const string& family, Sampler& random) {
  constexpr double g = 9.80665;
  if (family == "generic") return thrown(random, g, random.uniform(0.2, 2), 2);
  if (family == "fast") return thrown(random, g, random.log_uniform(1e-4, 1e-2), 1.6);
  if (family == "weak_g") return thrown(random, random.log_uniform(1e-9, 1e-4), random.uniform(0.2, 2), 1.6);

  if (family == "graze") {
    // The sum of radii is the least distance but for a part in 1e10.
    Scenario path = thrown(random, g, random.uniform(0.2, 0.6), 3);
    const auto distance = [&](double t) {
      return (path.motion.d + t * path.motion.w + 0.5 * t * t * path.motion.a).norm();
    };

    double best = 0;
    for (int k = 0; k <= 4000; ++k)
      if (distance(1e-3 * k) < distance(best)) best = 1e-3 * k;
    double low = best - 1e-3, high = best + 1e-3;
    for (int k = 0; k < 200; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }

    path.s = distance(low) * (1 + 1e-10);
    return path;
  }

  const double speed = std::stod(family.substr(7));  // bounce_<speed>
  const Vec3 n = (Vec3(0, -1, 0) + random.vector(0.5)).normalized();
  RelativeMotion m{n, speed * n, Vec3(0, g, 0), speed, true};
  return {m, 1};
}

struct Row {
  const char* family;
  double median, worst;  // of the cascade's relative errors
};

TEST(Quartic, ABallAndAFixedBallAreAsExactAsTheReferenceTablesCascade) {
  const Row rows[] = {{"generic", 2.6e-16, 4.2e-14},     {"fast", 3.2e-16, 3.1e-15},
                      {"weak_g", 3.1e-16, 8.2e-15},      {"graze", 3.8e-12, 3e-11},
                      {"bounce_1", 1.2e-16, 6e-16},      {"bounce_0.01", 1.4e-16, 6e-16},
                      {"bounce_0.0001", 1.2e-16, 6e-16}, {"bounce_1e-06", 1.2e-16, 6e-16}};

  World world;
  world.mass = {1};
  world.restitution = {1};
  world.radius = {0.5};
  world.obstacles = {{Vec3::Zero(), Volume::sphere(0.5), nullopt}};

  for (const Row& row : rows) {
    Sampler random(7);
    int hits = 0, missed = 0, invented = 0;
    vector<double> errors;

    for (int k = 0; k < 400; ++k) {
      const Scenario c = scenario(row.family, random);
      world.radius[0] = 0.5 * c.s;
      world.obstacles[0].volume = Volume::sphere(0.5 * c.s);
      const bool left = c.motion.just_separated;
      const double t = time_of_impact(world, 0, 1, c.motion, left ? 0 : no_feature, 100).time;

      const Quad expected = reference(c.motion, c.s, left, 100);
      hits += expected >= 0;
      missed += expected >= 0 && t == never;
      invented += expected < 0 && t < never;
      if (expected >= 0 && t < never) {
        const Quad error = (t - expected) / expected;
        errors.push_back(std::abs(static_cast<double>(error)));
      }
    }

    ranges::sort(errors);
    const double median = errors[errors.size() / 2], worst = errors.back();
    printf("%-14s %3d hits, %d missed, %d invented, relative error: median %.2g, worst %.2g\n", row.family, hits,
           missed, invented, median, worst);

    EXPECT_EQ(missed, 0) << row.family;
    EXPECT_EQ(invented, 0) << row.family;
    EXPECT_GT(hits, 90) << row.family;
    EXPECT_LE(median, row.median) << row.family;
    EXPECT_LE(worst, row.worst) << row.family;
  }
}

}  // namespace
}  // namespace carom
