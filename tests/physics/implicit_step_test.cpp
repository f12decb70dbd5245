// The implicit step against motions in closed form, a reference in long double, and the slow motion that stiff forces
// leave.
#include "physics/implicit_step.h"

#include <gtest/gtest.h>

#include <numbers>

#include "numerics/dormand_prince.h"
#include "std.h"
#include "stiff_reference.h"

namespace carom {
namespace {

constexpr double tolerance = 1e-12;  // m and m/s, by step

/// Forces on a mass of 1 kg.
struct Forces {
  Vec3 pull = Vec3::Zero();  // m/s^2
  Drag drag;
  Spring spring;
  Attractor attractor{Vec3::Zero(), 0, 1};

  Vec3 acceleration(const Vec3& x, const Vec3& v) const {
    const Particle p{x, v, 1};
    return pull + drag.acceleration(p) + spring.acceleration(p) + attractor.acceleration(p);
  }
  ForceJacobian derivatives(const Vec3& x, const Vec3& v) const {
    const Particle p{x, v, 1};
    ForceJacobian j = jacobian(drag, p);
    j += jacobian(spring, p);
    return j += jacobian(attractor, p);
  }
  double step(ImplicitStep& method, double h, const Vec3& x, const Vec3& v, double position, double velocity) const {
    return method.step(
        h, x, v, [this](const Vec3& at, const Vec3& speed) { return acceleration(at, speed); },
        [this](const Vec3& at, const Vec3& speed) { return derivatives(at, speed); }, position, velocity);
  }
};

struct Place {
  Vec3 x, v;  // m, m/s
};

/// A motion in steps as long as their errors allow, and its distance from the exact one.
struct Motion {
  Vec3 x, v;
  int steps = 0, rejected = 0;
  double off = 0, fast = 0;  // m, m/s: from the exact motion at most

  using Exact = function<Place(double t)>;

  void go(const Forces& forces, double duration, double h, const Exact& exact, double velocity = tolerance) {
    ImplicitStep method;
    for (double t = 0; t < duration && steps + rejected < 5000;) {
      const bool last = t + h >= duration;
      if (last) h = duration - t;
      const double error = forces.step(method, h, x, v, tolerance, velocity);
      const double next = DormandPrince::next_length(h, error);

      if (error <= 1) {
        take(method.path(), t, exact);
        t = last ? duration : t + h;
        ++steps;
      } else {
        ++rejected;
      }

      h = next;
    }
  }

 private:
  void take(const PolynomialPath& path, double t, const Exact& exact) {
    for (const double s : {0.015, 0.1, 0.25, 0.5, 0.7, 0.9, 1.0}) {
      const double after = s * path.length;
      const Place there = exact ? exact(t + after) : Place{x + path.displacement_at(after), v + path.change_at(after)};
      off = std::max(off, (x + path.displacement_at(after) - there.x).cwiseAbs().maxCoeff());
      fast = std::max(fast, (v + path.change_at(after) - there.v).cwiseAbs().maxCoeff());
    }
    x += path.displacement_at(path.length);
    v += path.change_at(path.length);
  }
};

/// Central differences of order 6 of the acceleration.
template <class Law>
ForceJacobian differences(const Law& law, const Particle& p) {
  constexpr double h = 0x1p-9;
  const auto slope = [&](Vec3 Particle::*of, int axis) {
    const auto pair = [&](int k) {
      Particle after = p, before = p;
      (after.*of)[axis] += k * h;
      (before.*of)[axis] -= k * h;
      return Vec3((law.acceleration(after) - law.acceleration(before)) / (2 * k * h));
    };
    return Vec3(1.5 * pair(1) - 0.6 * pair(2) + 0.1 * pair(3));
  };

  ForceJacobian j;
  for (int axis = 0; axis < 3; ++axis) {
    j.by_position.col(axis) = slope(&Particle::x, axis);
    j.by_velocity.col(axis) = slope(&Particle::v, axis);
  }
  return j;
}

template <class Law>
void expect_derivatives(const Law& law, const Particle& p) {
  const ForceJacobian exact = jacobian(law, p), near = differences(law, p);
  const double scale = 1 + exact.by_position.norm() + exact.by_velocity.norm();
  EXPECT_LT((exact.by_position - near.by_position).norm() / scale, 1e-11);  // measured: 1.1e-13 at most
  EXPECT_LT((exact.by_velocity - near.by_velocity).norm() / scale, 1e-11);
}

TEST(ForceJacobian, IsWhatDifferencesComeTo) {
  for (const Particle& p : {Particle{{1, 2, -0.5}, {0.3, -1, 2}, 1.5}, Particle{{-2, 0.1, 0.7}, {-3, 0, 1}, 0.25}}) {
    expect_derivatives(Drag{2, 0, {1, 0, 0}}, p);
    expect_derivatives(Drag{2, 3, {1, 0.5, 0}}, p);
    expect_derivatives(Spring{{0.2, 0.1, 0}, 7, 0, 0}, p);
    expect_derivatives(Spring{{0.2, 0.1, 0}, 7, 1.3, 5}, p);
    expect_derivatives(Attractor{{0.5, 0, 0}, 4, 0.3}, p);
    expect_derivatives(Attractor{{0.5, 0, 0}, -4, 0}, p);
  }
}

TEST(ForceJacobian, IsFiniteWhereADirectionIsLost) {
  const Particle p{Vec3(1, 2, 3), Vec3(4, 5, 6), 2};
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  EXPECT_EQ(jacobian(Drag{2, 3, p.v}, p).by_velocity, -1 * one);
  const ForceJacobian spring = jacobian(Spring{p.x, 8, 1, 6}, p);
  EXPECT_EQ(spring.by_position, -4 * one);
  EXPECT_EQ(spring.by_velocity, -3 * one);
  EXPECT_EQ(jacobian(Attractor{p.x, 8, 2}, p).by_position, -1 * one);
  EXPECT_TRUE(jacobian(Attractor{p.x, 8, 0}, p).by_position.allFinite());
}

TEST(ImplicitStep, HasOrder13AtItsEndAnd8Before) {
  Forces forces;
  forces.spring = {Vec3::Zero(), 1, 0, 0};

  const auto miss = [&](double h, double s) {
    ImplicitStep method;
    forces.step(method, h, {1, 0.5, 0}, {0.3, 0, 1}, 1e-13, 1e-13);
    const PolynomialPath path = method.path();
    const double t = s * h, c = std::cos(t), d = std::sin(t);
    return pair{(Vec3(1, 0.5, 0) + path.displacement_at(t) - Vec3(c + 0.3 * d, 0.5 * c, d)).norm(),
                (Vec3(0.3, 0, 1) + path.change_at(t) - Vec3(0.3 * c - d, -0.5 * d, c)).norm()};
  };

  const auto order = [&](double h, double s) {  // of the local error
    const auto [x, v] = miss(h, s);
    const auto [half_x, half_v] = miss(h / 2, s);
    return pair{std::log2(x / half_x), std::log2(v / half_v)};
  };

  const auto [end_x, end_v] = order(3, 1);
  EXPECT_NEAR(end_x, 14, 0.6);  // measured: 13.95
  EXPECT_NEAR(end_v, 14, 0.6);  // measured: 13.58

  const auto [x, v] = order(1, 0.2);
  EXPECT_NEAR(x, 9, 0.2);  // measured: 8.93
  EXPECT_NEAR(v, 8, 0.2);  // measured: 7.94
}

TEST(ImplicitStep, BeginsAtTheStartAndEndsWhereStagesDo) {
  Forces forces;
  forces.drag = {300, 2, {1, 0, 0}};
  forces.attractor = {Vec3::Zero(), 1, 0.3};
  const Vec3 x(1, 0, 0.1), v(0, 1, 0);
  ImplicitStep method;
  for (const double h : {1e-4, 0.01, 0.125}) {
    forces.step(method, h, x, v, 1e-12, 1e-12);
    const PolynomialPath path = method.path();
    EXPECT_EQ(path.displacement_at(0), Vec3::Zero());
    EXPECT_EQ(path.change_at(0), Vec3::Zero());
    EXPECT_LT((path.displacement[0] / h - v).norm(), 1e-15);
    // At the end, the last stage, the polynomial's acceleration is the forces'.
    const Vec3 end_x = x + path.displacement_at(h), end_v = v + path.change_at(h);
    EXPECT_LT((path.acceleration(h) - forces.acceleration(end_x, end_v)).norm() * h, 1e-9) << h;  // measured: 9e-11
  }
}

TEST(ImplicitStep, OfLinearDragIsTheClosedFormOverDecades) {
  for (int decade = 0; decade <= 10; ++decade) {
    const double c = pow(10, decade);
    Forces forces;
    forces.pull = {0, -9, 0};
    forces.drag.linear = c;
    const Vec3 v0(1, 0, 0.5);

    const auto exact = [&](double t) {
      const double s = -std::expm1(-c * t) / c, fallen = c * t < 1e-3 ? t * t / 2 * (1 - c * t / 3) : (t - s) / c;
      return Place{s * v0 - 9 * fallen * Vec3(0, 1, 0), (1 - c * s) * v0 - 9 * s * Vec3(0, 1, 0)};
    };

    for (const double first : {0.05 / c, 1.0}) {
      Motion run{Vec3::Zero(), v0};
      run.go(forces, 1, first, exact);
      EXPECT_LT(run.off, 2e-12) << c;   // measured: 4e-13 at most
      EXPECT_LT(run.fast, 4e-12) << c;  // measured: 1.2e-12 at most
      EXPECT_LT(run.steps + run.rejected, 60) << c;
    }
  }
}

TEST(ImplicitStep, OfQuadraticDragFallsToItsTerminalVelocity) {
  for (const double q : {1.0, 1e3, 1e6}) {
    Forces forces;
    forces.pull = {0, 0, -9};
    forces.drag.quadratic = q;
    const double terminal = 3 / sqrt(q), rate = 9 / terminal;

    const auto exact = [&](double t) {
      const double fallen = rate * t + std::log1p(std::exp(-2 * rate * t)) - std::numbers::ln2;
      return Place{{0, 0, -terminal / rate * fallen}, {0, 0, -terminal * std::tanh(rate * t)}};
    };

    Motion run{Vec3::Zero(), Vec3::Zero()};
    run.go(forces, 1, 1e-3 / rate, exact);
    EXPECT_LT(run.off, 1e-13) << q;   // measured: 6e-15 at most
    EXPECT_LT(run.fast, 2e-12) << q;  // measured: 5e-13 at most
    EXPECT_LT(run.steps + run.rejected, 60) << q;
  }
}

TEST(ImplicitStep, OfLinearAndQuadraticDragIsTheClosedForm) {
  for (const double c : {1.0, 1e3, 1e6}) {
    const double q = 0.3 * c, v0 = 10;
    Forces forces;
    forces.drag = {c, q, Vec3::Zero()};

    const auto exact = [&](double t) {
      const double spent = -std::expm1(-c * t) * q * v0 / c;
      return Place{{std::log1p(spent) / q, 0, 0}, {v0 * std::exp(-c * t) / (1 + spent), 0, 0}};
    };

    Motion run{Vec3::Zero(), Vec3(v0, 0, 0)};
    run.go(forces, 1, 1e-3 / c, exact);
    EXPECT_LT(run.off, 1e-12) << c;   // measured: 2.5e-13 at most
    EXPECT_LT(run.fast, 3e-12) << c;  // measured: 7e-13 at most
    EXPECT_LT(run.steps + run.rejected, 120) << c;
  }
}

TEST(ImplicitStep, OfAnOverdampedSpringCreepsToItsRestLength) {
  for (const double k : {1e2, 1e6, 1e10}) {
    const double c = 100 * sqrt(k), stretch = 0.5;
    Forces forces;
    forces.spring = {Vec3::Zero(), k, 1, c};
    const double root = sqrt(c * c / 4 - k), slow = -k / (c / 2 + root), quick = -(c / 2 + root);

    const auto exact = [&](double t) {
      const double a = -quick * stretch / (slow - quick), b = slow * stretch / (slow - quick);
      const double first = a * std::exp(slow * t), second = b * std::exp(quick * t);
      return Place{{1 + first + second, 0, 0}, {slow * first + quick * second, 0, 0}};
    };

    Motion run{Vec3(1 + stretch, 0, 0), Vec3::Zero()};
    run.go(forces, 1, 0.01 / c, exact, tolerance * sqrt(k));
    EXPECT_LT(run.off, 2e-12) << k;             // measured: 4e-13 at most
    EXPECT_LT(run.fast, 4e-12 * sqrt(k)) << k;  // measured: 1.5e-13 of the root at most
    EXPECT_LT(run.steps + run.rejected, 80) << k;
  }
}

Long3 damped_and_attracted(const Long3& x, const Long3& v, long double damping) {
  const long double square = x[0] * x[0] + x[1] * x[1], along = damping * (x[0] * v[0] + x[1] * v[1]) / square;
  const long double d = x[0] - 0.25L, soft = d * d + x[1] * x[1] + 0.0625L, pull = 1 / (soft * sqrt(soft));
  return {-along * x[0] - pull * d, -along * x[1] - pull * x[1], 0};
}

Forces damper_and_attractor(double damping) {
  Forces forces;
  forces.spring = {Vec3::Zero(), 0, 0, damping};
  forces.attractor = {Vec3(0.25, 0, 0), 1, 0.25};
  return forces;
}

TEST(ImplicitStep, AcrossADamperIsWhatALongReferenceComesTo) {
  constexpr double damping = 2048;
  LongState s{{1, 0, 0}, {0.5L, 2, 0}};
  const int steps = 8192;
  for (int k = 0; k < steps; ++k)
    s = extrapolated_step(s, 1.0L / steps,
                          [&](const Long3& x, const Long3& v) { return damped_and_attracted(x, v, damping); });

  Motion run{Vec3(1, 0, 0), Vec3(0.5, 2, 0)};
  run.go(damper_and_attractor(damping), 1, 0.05 / damping, nullptr);

  for (int axis = 0; axis < 3; ++axis) {
    const auto p = static_cast<size_t>(axis);
    EXPECT_LT(std::abs(static_cast<double>(run.x[axis] - s.x[p])), 1e-12) << axis;
    EXPECT_LT(std::abs(static_cast<double>(run.v[axis] - s.v[p])), 2e-12) << axis;
  }
  EXPECT_LT(run.steps + run.rejected, 80);
}

/// The slow motion that a damper leaves: x' = w t + r' n, with r' from the radial balance r' c = w^2 / r + pull . n, to
/// order 1 / c.
LongState slow_motion(LongState s, long double damping, long double duration, int steps) {
  // In polar coordinates: x = (r, angle, -), v = (-, w, -), where only w obeys a law of second order.
  const auto rates = [&](const Long3& y) {  // of r, angle, w
    const long double r = y[0], c = std::cos(y[1]), d = std::sin(y[1]), w = y[2];
    const Long3 pull = damped_and_attracted({r * c, r * d, 0}, {0, 0, 0}, 0);
    const long double outward = (w * w / r + pull[0] * c + pull[1] * d) / damping;
    return Long3{outward, w / r, -pull[0] * d + pull[1] * c - outward * w / r};
  };

  Long3 y{s.x[0], 0, s.v[1]};
  const long double h = duration / steps;
  const auto moved = [](const Long3& from, long double by, const Long3& rate) {
    return Long3{from[0] + by * rate[0], from[1] + by * rate[1], from[2] + by * rate[2]};
  };

  for (int k = 0; k < steps; ++k) {
    const Long3 a = rates(y), b = rates(moved(y, h / 2, a)), c = rates(moved(y, h / 2, b)), d = rates(moved(y, h, c));
    for (size_t p = 0; p < 3; ++p) y[p] += h / 6 * (a[p] + 2 * b[p] + 2 * c[p] + d[p]);
  }

  const long double c = std::cos(y[1]), d = std::sin(y[1]), outward = rates(y)[0];
  return {{y[0] * c, y[0] * d, 0}, {outward * c - y[2] * d, outward * d + y[2] * c, 0}};
}

TEST(ImplicitStep, AcrossAStiffDamperIsTheSlowMotion) {
  constexpr double damping = 1e8;
  const LongState s = slow_motion({{1, 0, 0}, {0, 2, 0}}, damping, 1, 8192);
  // On the slow motion from the start, except for the damper's effect in order 1 / c^2.
  const auto outward = static_cast<double>((4 + damped_and_attracted({1, 0, 0}, {0, 0, 0}, 0)[0]) / damping);
  for (const double first : {1e-9, 0.1}) {
    Motion run{Vec3(1, 0, 0), Vec3(outward, 2, 0)};
    run.go(damper_and_attractor(damping), 1, first, nullptr);
    for (int axis = 0; axis < 3; ++axis) {
      const auto p = static_cast<size_t>(axis);
      EXPECT_LT(std::abs(static_cast<double>(run.x[axis] - s.x[p])), 1e-12) << axis;
      EXPECT_LT(std::abs(static_cast<double>(run.v[axis] - s.v[p])), 2e-12) << axis;
    }
    EXPECT_LT(run.steps + run.rejected, 60);  // measured: 25 and 12
  }
}

TEST(ImplicitStep, TakesFewStepsOffTheSlowMotion) {
  Forces drag;
  drag.drag.linear = 1e8;
  drag.attractor = {Vec3::Zero(), 1, 0.2};
  Motion dragged{Vec3(1, 0, 0), Vec3(0, 2, 0)};
  dragged.go(drag, 1, 1, nullptr);
  EXPECT_LT(dragged.steps + dragged.rejected, 80);
  // It creeps down the attractor's slope: r' = -mu r / (r^2 + s^2)^(3/2) / c, here for so short a way that it is even.
  const double crept = 1 / pow(1.04, 1.5) / 1e8;
  EXPECT_NEAR(dragged.x[0], 1 - crept, 1e-14);
  EXPECT_NEAR(dragged.x[1], 2e-8, 1e-14);

  Motion damped{Vec3(1, 0, 0), Vec3(1, 2, 0)};  // outward at the damper's speed
  damped.go(damper_and_attractor(1e8), 1, 0.1, nullptr);
  EXPECT_LT(damped.steps + damped.rejected, 100);
}

TEST(ImplicitStep, ReportsAStepThatIsTooLong) {
  Forces forces;
  forces.drag.linear = 1e6;
  ImplicitStep method;
  const Vec3 x = Vec3::Zero();
  EXPECT_GT(forces.step(method, 0.1, x, {1, 0, 0}, 1, 1e-3), 100);      // the velocity is gone at once
  EXPECT_GT(forces.step(method, 0.1, x, {1, 0, 0}, 1e-6, 1e9), 100);    // and less of the way is gone than estimated
  EXPECT_GT(forces.step(method, 0.1, x, {1e-9, 0, 0}, 1, 1e-12), 100);  // a small one too,
  forces.pull = {0, 1e7, 0};                                            // also beside a great pull
  EXPECT_GT(forces.step(method, 0.1, x, {1e-9, 10, 0}, 1, 1e-12), 100);
  EXPECT_LT(forces.step(method, 0.1, x, {1e-13, 10, 0}, 1, 1e-12), 1);
}

TEST(ImplicitStep, ReportsThatNoStagesAreFound) {
  Forces forces;
  forces.attractor = {Vec3::Zero(), 1, 0};
  ImplicitStep method;
  EXPECT_EQ(forces.step(method, 10, Vec3::Zero(), Vec3::Zero(), 1, 1), infinity);
  forces.pull[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(forces.step(method, 1, {1, 1, 1}, Vec3::Zero(), 1, 1), infinity);
  EXPECT_LT(DormandPrince::next_length(1, infinity), 0.5);
}

/// The same forces where lengths are `l` and times `t` times as long.
Forces scaled(Forces f, double l, double t) {
  f.pull *= l / (t * t);
  f.drag.linear /= t;
  f.drag.quadratic /= l;
  f.drag.wind *= l / t;

  f.spring.anchor *= l;
  f.spring.stiffness /= t * t;
  f.spring.rest_length *= l;
  f.spring.damping /= t;

  f.attractor.center *= l;
  f.attractor.strength *= l * l * l / (t * t);
  f.attractor.softening *= l;
  return f;
}

TEST(ImplicitStep, HasTheSameBitsInUnitsOfPowersOfTwo) {
  Forces forces;
  forces.pull = {0, -9.81, 0.3};
  forces.drag = {3.7, 0.9, {0.1, 0.2, -1}};
  forces.spring = {{0.3, 0.1, 0}, 1e4, 0.7, 1e5};
  forces.attractor = {{-0.3, 0, 0.2}, 2.3, 0.15};
  const Vec3 x(1, 0.2, 0.1), v(0.01, 1.7, 0.2);
  ImplicitStep method, other;
  for (const double h : {0.0002, 0.003, 0.02, 0.1})
    for (const double l : {0x1p-40, 0x1p30})
      for (const double t : {0x1p-30, 0x1p20}) {
        const double error = forces.step(method, h, x, v, 1e-12, 1e-10);
        const double same = scaled(forces, l, t).step(other, t * h, l * x, l / t * v, l * 1e-12, l / t * 1e-10);
        EXPECT_EQ(error, same) << h;

        const PolynomialPath path = method.path(), in_units = other.path();
        for (size_t k = 0; k < PolynomialPath::terms; ++k)
          EXPECT_EQ(Vec3(l * path.displacement[k]), in_units.displacement[k]) << h;
      }
}

TEST(ImplicitStep, ErrorIsWhatIsMissedWithinTheStep) {
  // An eccentric orbit and its reference, at steps of many lengths.
  Forces forces;
  forces.attractor = {Vec3::Zero(), 1, 0};
  const LongForce exact = [](const Long3& x, const Long3&) {
    const long double square = x[0] * x[0] + x[1] * x[1], pull = 1 / (square * sqrt(square));
    return Long3{-pull * x[0], -pull * x[1], 0};
  };

  ImplicitStep method;
  for (double h = 0.05; h < 0.5; h *= 1.5) {
    const Vec3 x0(0.7, 0.1, 0), v0(0, 1.4, 0);
    const double estimated = forces.step(method, h, x0, v0, 1e200, 1e-12) * 1e-12;
    const PolynomialPath path = method.path();

    LongState s{{0.7, 0.1, 0}, {0, 1.4, 0}};
    double missed = 0;
    for (int k = 1; k <= 40; ++k) {
      s = extrapolated_step(s, static_cast<long double>(h) / 40, exact);
      const Vec3 v = v0 + path.change_at(h * k / 40);
      for (int axis = 0; axis < 2; ++axis)
        missed = std::max(missed, std::abs(static_cast<double>(s.v[static_cast<size_t>(axis)] - v[axis])));
    }

    if (missed < 1e-13) continue;             // the stages are no better
    EXPECT_LT(missed, 1.2 * estimated) << h;  // measured: 0.92 to 0.99
    EXPECT_GT(missed, 0.7 * estimated) << h;
  }
}

}  // namespace
}  // namespace carom
