#pragma once
// Kepler's motion in 64-bit mantissas by his own equation: the reference of orbits.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class LongKepler {
 public:
  using Real = long double;
  using Real3 = Eigen::Matrix<Real, 3, 1>;

  /// About the origin; mu > 0 (m^3/s^2), x (m), v (m/s), an energy that is not 0.
  LongKepler(double mu, const Vec3& x, const Vec3& v) : mu_(mu) {
    const Real3 r = x.cast<Real>(), u = v.cast<Real>(), h = r.cross(u);
    const Real energy = u.squaredNorm() / 2 - mu_ / r.norm();
    a_ = -mu_ / (2 * energy);  // negative: a hyperbola

    const Real3 e = u.cross(h) / mu_ - r / r.norm();
    e_ = e.norm();
    ahead_ = e_ > 0 ? Real3(e / e_) : Real3(r / r.norm());
    aside_ = h.cross(ahead_) / h.norm();
    short_ = h.norm() / sqrt(std::abs(2 * energy));
    rate_ = sqrt(mu_ / std::abs(a_ * a_ * a_));

    // Where it is at the start.
    const Real s = r.dot(u) / sqrt(mu_ * std::abs(a_));  // e sin E, or e sinh H
    if (a_ > 0) {
      const Real anomaly = std::atan2(r.dot(aside_) / short_, r.dot(ahead_) / a_ + e_);
      phase_ = anomaly - e_ * std::sin(anomaly);
    } else {
      phase_ = s - std::asinh(s / e_);
    }
  }

  Real period() const { return 2 * std::acos(Real{-1}) / rate_; }  // s

  /// m, t (s) after the start.
  Vec3 at(Real t) const {
    const Real m = phase_ + rate_ * t;
    Real along, across;
    if (a_ > 0) {
      const Real turn = 2 * std::acos(Real{-1}), mean = m - turn * std::round(m / turn);
      const Real anomaly = solve(mean, -4, 4, [&](Real z) { return z - e_ * std::sin(z); });
      along = a_ * (std::cos(anomaly) - e_);
      across = short_ * std::sin(anomaly);
    } else {
      const Real most = std::asinh((std::abs(m) + 1) / e_) + 50;
      const Real anomaly = solve(m, -most, most, [&](Real z) { return e_ * std::sinh(z) - z; });
      along = a_ * (std::cosh(anomaly) - e_);
      across = short_ * std::sinh(anomaly);
    }

    return (along * ahead_ + across * aside_).template cast<double>();
  }

 private:
  /// Where a rising function has this value: by halving, to the last digit.
  template <typename Function>
  static Real solve(Real value, Real low, Real high, const Function& f) {
    for (int k = 0; k < 200; ++k) {
      const Real middle = (low + high) / 2;
      (f(middle) < value ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  Real mu_, a_, e_, short_, rate_, phase_;
  Real3 ahead_, aside_;
};

}  // namespace carom
