// Collocation at Radau's points against motions in closed form and the explicit method of order 8.
#include "numerics/radau_collocation.h"

#include <gtest/gtest.h>

#include "numerics/dormand_prince.h"
#include "std.h"

namespace carom {
namespace {

/// A point on a ball of radius 1 about the origin, in a wind along x.
struct OnABall {
  double fade;
  Vec3 wind{2, 0, 0};

  static void hold(const vector<Vec3>& x, double, vector<Vec3>& u) {
    const Vec3 n = x[0].normalized();
    u[0] -= n.dot(u[0]) * n;
  }
  vector<RadauCollocation::Forces> forces() const { return {{fade * wind, fade}}; }
  vector<Vec3> accelerate(const vector<Vec3>& x, const vector<Vec3>& v) const {
    Vec3 a = fade * (wind - v[0]);
    const Vec3 n = x[0].normalized();
    a -= (n.dot(a) + v[0].squaredNorm() / x[0].norm()) * n;
    return {a};
  }
  /// Position and velocity after t (s) in many steps of the explicit method.
  pair<Vec3, Vec3> after(double t, Vec3 x, Vec3 v) const {
    const int steps = std::max(static_cast<int>(20 * fade * t), 200);
    const auto a = [this](const vector<Vec3>& p, const vector<Vec3>& u) { return accelerate(p, u); };
    for (int k = 0; k < steps; ++k) {
      DormandPrince motion({x}, {v}, accelerate({x}, {v}));
      motion.step(t / steps, a, 1, 1);
      motion.interpolate(a);
      x += motion.displacement(0, t / steps);
      v = motion.velocity(0, t / steps);
    }
    return {x, v};
  }
};

TEST(RadauCollocation, OfAPointThatDragStopsIsTheClosedForm) {
  for (const double fade : {0.1, 1.0, 3.0}) {
    const double h = 0.05;
    RadauCollocation motion({Vec3::Zero()}, {Vec3(1, 0, 0)});
    const vector<RadauCollocation::Forces> forces{{Vec3(0, -9, 0), fade}};
    const auto free = [](const vector<Vec3>&, double, vector<Vec3>&) {};
    EXPECT_LT(motion.step(h, forces, free, 1e-11, 1e-11), 1) << fade;

    for (const double t : {0.0125, 0.025, h}) {
      const double s = -std::expm1(-fade * t) / fade;
      EXPECT_LT((motion.displacement(0, t) - Vec3(s, -9 * (t - s) / fade, 0)).norm(), 1e-14) << fade;
      EXPECT_LT((motion.velocity(0, t) - Vec3(1 - fade * s, -9 * s, 0)).norm(), t == h ? 1e-13 : 1e-11) << fade;
    }
  }
}

TEST(RadauCollocation, OnASurfaceIsWhatTheExplicitMethodComesTo) {
  for (const double fade : {1.0, 100.0, 3000.0}) {
    const OnABall ball{fade};
    // Along the path on which drag is over.
    const auto [x, v] = ball.after(40 / fade, Vec3(0.1, sqrt(1 - 0.01), 0), Vec3::Zero());
    const double h = 0.05;
    RadauCollocation motion({x}, {v});
    EXPECT_LT(motion.step(h, ball.forces(), OnABall::hold, 1e-10, 1e-10), 1) << fade;
    const auto [there, speed] = ball.after(h, x, v);
    EXPECT_LT((x + motion.displacement(0, h) - there).norm(), 1e-13) << fade;
    EXPECT_LT((motion.velocity(0, h) - speed).norm(), 1e-12) << fade;
    const auto [half, half_speed] = ball.after(0.5 * h, x, v);
    EXPECT_LT((x + motion.displacement(0, 0.5 * h) - half).norm(), 1e-13) << fade;
    EXPECT_LT((motion.velocity(0, 0.5 * h) - half_speed).norm(), 1e-11) << fade;
  }
}

TEST(RadauCollocation, ReportsAStepThatIsTooLong) {
  const OnABall ball{1000};
  RadauCollocation motion({Vec3(0, 1, 0)}, {Vec3(-1, 0, 0)});  // against the wind: drag is not over
  EXPECT_GT(motion.step(0.1, ball.forces(), OnABall::hold, 1e-10, 1e-10), 1);
}

}  // namespace
}  // namespace carom
