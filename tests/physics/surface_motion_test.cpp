// The motion of fixed things against long double: without an error that grows, however late.
#include "physics/surface_motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr long double turn = 2 * std::numbers::pi_v<long double>;

TEST(SurfaceMotion, OfASineIsThatOfLongDoubleAfterAThousandPeriods) {
  const SurfaceMotion motion = motion_on_sine({0, 0.25, 0}, 0.1, 30);
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.1 * k + 1e-4 * k;
    const long double angle = turn * (static_cast<long double>(t) / static_cast<long double>(0.1) + 1.0L / 12);
    const long double start = std::sin(turn / 12);
    const long double rate = turn / static_cast<long double>(0.1);
    EXPECT_NEAR(place_on(Vec3::Zero(), motion, {t, 0}).y(), double(0.25L * (std::sin(angle) - start)), 2e-16) << k;
    EXPECT_NEAR(velocity_on(motion, {t, 0}).y(), double(0.25L * rate * std::cos(angle)), 1e-14) << k;
    EXPECT_NEAR(acceleration_on(motion, {t, 0}).y(), double(-0.25L * rate * rate * std::sin(angle)), 5e-13) << k;
  }
}

TEST(SurfaceMotion, OfASwingIsAPolynomialToRoundingForItsSmoothTime) {
  const Swing swing{0.5, {0, 0, 0}, {1, 0, 0.5}, {0, 2, 0}};
  SurfaceMotion motion;
  motion.swing = swing;

  const double length = smooth_time(swing);
  double worst = 0;
  for (int k = 0; k < 40; ++k) {
    const double from = 0.5 * k / 40;
    const PolynomialPath::Terms terms = displacement_on(swing, {from, 0}, length);
    const Vec3 start = place_on(Vec3::Zero(), motion, {from, 0});
    for (const double s : {0.1, 0.25, 0.5, 0.7, 1.0}) {
      const Vec3 way = place_on(Vec3::Zero(), motion, {from + s * length, 0}) - start;
      worst = max(worst, (PolynomialPath::value(terms, s) - way).norm());
    }
    EXPECT_LT((terms[0] - length * velocity_on(motion, {from, 0})).norm(), 1e-16);
  }
  EXPECT_LT(worst, 2e-15);  // of an amplitude of 2 m; measured: 9e-16
}

TEST(SurfaceMotion, ThatRepeatsHasEachLegFromItsOwnStartOn) {
  // Neither the period nor the starts are numbers that doubles hold.
  const vector<MotionWindow> windows = {{0.1, 0.3, {1, 0, 0}}, {0.4, 0.6, {-0.7, 0, 0}}};
  const SurfaceMotion motion = motion_in_windows(windows, 0.7);
  DoubleDouble now{0, 0};
  for (int k = 0; k < 40000; ++k) {
    const DoubleDouble next = next_leg_start(motion, now);
    ASSERT_TRUE(now.hi < next.hi || (now.hi == next.hi && now.lo < next.lo)) << k;
    const DoubleDouble begun = leg_start(motion, next);
    ASSERT_TRUE(begun.hi == next.hi && begun.lo == next.lo) << k;
    now = next;
  }

  // Four legs a period: the standing one goes on from the period before.
  EXPECT_NEAR(now.hi, 0.7 * 9999 + 0.6, 1e-9);
  const double gain = 0.2 * 1 - 0.2 * 0.7;
  EXPECT_NEAR(place_on(Vec3::Zero(), motion, now).x(), 10000 * gain, 1e-11);
}

TEST(SurfaceMotion, GoesAsFarAsItsExtremes) {
  const SurfaceMotion sine = motion_on_sine({0, 0.5, 0}, 2, -90);
  EXPECT_NEAR(swept_along(sine, {0, 1, 0}), 1, 1e-15);
  EXPECT_NEAR(swept_along(sine, {0, -1, 0}), 0, 1e-15);
  const SurfaceMotion circle = motion_on_circle({1, 0, 0}, {0, 0, 5}, {0, 0, 1}, 2);
  EXPECT_NEAR(swept_along(circle, {-1, 0, 0}), 2, 1e-15);
  EXPECT_NEAR(swept_along(circle, {0, 1, 0}), 1, 1e-15);
  EXPECT_EQ(swept_along(circle, {0, 0, 1}), 0);

  const vector<MotionWindow> windows = {{0, 1, {1, 0, 0}}, {1, 2, {-1, 1, 0}}};
  const SurfaceMotion drifts = motion_in_windows(windows, 2);
  EXPECT_EQ(swept_along(drifts, {1, 0, 0}), 1);
  EXPECT_EQ(swept_along(drifts, {0, 1, 0}), infinity);
}

}  // namespace
}  // namespace carom
