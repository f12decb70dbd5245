#pragma once
// The motion of many points in one step of a method, with dense output: it can be evaluated at every instant of the
// step.

#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class DenseMotion {
 public:
  virtual ~DenseMotion() = default;

  /// Point k's displacement from the start (m) and its velocity (m/s), t (s) after the start, 0 <= t <= length().
  virtual Vec3 displacement(size_t k, double t) const = 0;
  virtual Vec3 velocity(size_t k, double t) const = 0;
  /// Its path: the integral of that velocity.
  virtual PolynomialPath path(size_t k) const = 0;

  /// Positions (m) and velocities (m/s) of all points at t (s).
  void at(double t, vector<Vec3>& x, vector<Vec3>& v) const {
    x.resize(size());
    v.resize(size());
    for (size_t k = 0; k < size(); ++k) {
      x[k] = start(k) + displacement(k, t);
      v[k] = velocity(k, t);
    }
  }
  double length() const { return length_; }            // s
  const Vec3& start(size_t k) const { return x_[k]; }  // m
  size_t size() const { return x_.size(); }

  void keep(auto& archive) { archive(x_, v_, length_); }

 protected:
  DenseMotion(vector<Vec3> x, vector<Vec3> v) : x_(std::move(x)), v_(std::move(v)) {}

  vector<Vec3> x_, v_;  // m and m/s, at the start
  double length_ = 0;   // s
};

}  // namespace carom
