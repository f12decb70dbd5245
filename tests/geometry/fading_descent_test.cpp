// Times at which quantities under linear drag descend through zero.
#include "geometry/fading_descent.h"

#include <gtest/gtest.h>

#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

TEST(Fading, IsTheExponential) {
  for (const double z : {1e-12, 0.1, 0.5, 0.7, 3.0, 20.0, 60.0, 1e3, 1e9}) {
    const Fading f = fading(z);
    EXPECT_NEAR(f.gone / -std::expm1(-z), 1, 4e-16) << z;
    const double bend = z < 0.1 ? 0.5 - z / 6 : (z + std::expm1(-z)) / (z * z);
    EXPECT_NEAR(f.bend / bend, 1, 1e-14) << z;
  }
}

TEST(Fading, SquaredSpeedIsTheIntegral) {
  for (const double fade : {0.0, 1e-9, 0.3, 40.0}) {
    const FadingPath path{Vec3::Zero(), {3, -1, 0}, {-2, 5, 1}, fade};
    const double t = 1.5;

    double sum = 0;
    constexpr int parts = 4000;
    for (int k = 0; k < parts; ++k) {  // Simpson's rule
      const double h = t / parts, from = k * h;
      sum += h / 6 *
             (path.velocity(from).squaredNorm() + 4 * path.velocity(from + h / 2).squaredNorm() +
              path.velocity(from + h).squaredNorm());
    }

    EXPECT_NEAR(path.squared_speed(t) / sum, 1, 1e-12) << fade;
  }
}

/// The first of many samples that is not above zero after one that was.
double first_sample(const FadingDistance& f, double horizon) {
  constexpr int samples = 20000;
  for (int k = 1; k <= samples; ++k)
    if (f(horizon * k / samples) <= 0) return horizon * k / samples;
  return never;
}

TEST(FadingDescent, MissesNoneAndInventsNone) {
  SLOW_WITH_SANITIZERS();
  Random random;
  int found = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto fade = [&] { return random(0, 1) < 0.2 ? 0 : std::exp(random(-4, 6)); };
    const FadingDistance f{random(0.01, 1), random(-3, 3), {{{random(-20, 20), fade()}, {random(-20, 20), fade()}}}};
    const double horizon = random(0.1, 5), t = first_descent(f, horizon), sample = first_sample(f, horizon);

    if (t == never) {
      EXPECT_EQ(sample, never) << n;
      continue;
    }

    ++found;
    EXPECT_LE(t, horizon) << n;
    EXPECT_LE(t, sample) << n;  // a dip between two samples is found too
    EXPECT_NEAR(f(t), 0, 1e-13 * (1 + std::abs(f.rate) * t + 20 * t * t)) << n;
    EXPECT_LE(f.slope(t), 1e-6) << n;
  }

  EXPECT_GT(found, 500);
}

TEST(FadingDescent, FromContactIsWhereItComesBack) {
  SLOW_WITH_SANITIZERS();
  // Thrown up at 1 m/s under a pull of 10 m/s^2 and drag: down again before 0.2 s, the sooner the stronger drag is.
  double last = 0.2;
  for (const double fade : {1e-6, 0.1, 1.0, 10.0, 1000.0}) {
    const FadingDistance f{0, 1, {{{-10 - fade, fade}, {0, 0}}}};
    const double t = first_descent(f, 1e9);
    EXPECT_LT(t, last);
    EXPECT_NEAR(f(t), 0, 1e-16);
    last = t;
  }
}

}  // namespace
}  // namespace carom
