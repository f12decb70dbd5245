// The stable steps of the methods with steps of one length, against their closed forms and against motions.
#include "physics/stability.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

double stable(Integrator method, double stiffness, double damping) {
  ForceJacobian slopes;
  slopes.by_position = -stiffness * Eigen::Matrix3d::Identity();
  slopes.by_velocity = -damping * Eigen::Matrix3d::Identity();
  LinearMode mode;
  const double step = stable_step(method, slopes, mode);
  EXPECT_EQ(mode.stiffness, stiffness);
  EXPECT_EQ(mode.damping, damping);
  return step;
}

// rk4: |1 + z + z^2/2 + z^3/6 + z^4/24| = 1 at z = i sqrt(8) and at z = -2.785293563405282 (Hairer & Wanner 1996,
// IV.2).
TEST(StableStep, OfSwingsAndDecaysIsThatOfTheClosedForm) {
  const double w = 300, c = 7e-5;
  EXPECT_NEAR(stable(Integrator::verlet, w * w, 0), 2 / w, 1e-9 / w);
  EXPECT_NEAR(stable(Integrator::euler, w * w, 0), 2 / w, 1e-9 / w);
  EXPECT_NEAR(stable(Integrator::rk4, w * w, 0), sqrt(8) / w, 2e-9 / w);
  EXPECT_NEAR(stable(Integrator::verlet, 0, c), 2 / c, 4e-9 / c);
  EXPECT_NEAR(stable(Integrator::euler, 0, c), 2 / c, 4e-9 / c);
  EXPECT_NEAR(stable(Integrator::rk4, 0, c), 2.785293563405282 / c, 6e-9 / c);
  // Euler's method of a damped swing: p h^2 + 2 c h = 4, by the Jury criterion.
  const double p = 40, d = 3;
  EXPECT_NEAR(stable(Integrator::euler, p, d), (-d + sqrt(d * d + 4 * p)) / p, 1e-9);
}

TEST(StableStep, IsThatOfTheStiffestDirection) {
  ForceJacobian slopes;
  const Vec3 along = Vec3(1, 2, 2) / 3;
  slopes.by_position = -900 * along * along.transpose();
  slopes.by_position += 5000 * Vec3(2, 1, -2) * Vec3(2, 1, -2).transpose() / 9;  // it pushes away
  LinearMode mode;
  EXPECT_NEAR(stable_step(Integrator::verlet, slopes, mode), 2.0 / 30, 1e-9);
  EXPECT_EQ(stable_step(Integrator::verlet, ForceJacobian{}, mode), infinity);
}

// A step multiplies amplitudes by this factor: 100 steps of rk4 with w h = 1.99 leave 0.751^100 of them.
TEST(Growth, IsTheFactorOfEachStep) {
  const double w = 199, h = 0.01;
  double x = 1, v = 0;

  for (int k = 0; k < 100; ++k) {
    const auto acceleration = [&](const Vec3& at, const Vec3&) { return Vec3(-w * w * at); };
    const Vec3 x0(x, 0, 0), v0(v, 0, 0);
    const StepChange step = runge_kutta(h, x0, v0, acceleration(x0, v0), acceleration);
    x += h * v + step.bend.x();
    v += step.change.x();
  }

  const double factor = growth(Integrator::rk4, {w * w, 0}, h);
  EXPECT_NEAR(factor, 0.751, 5e-4);
  EXPECT_NEAR(hypot(x, v / w) / pow(factor, 100), 1, 1e-11);
}

}  // namespace
}  // namespace carom
