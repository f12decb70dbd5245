#pragma once
// x'' = pull - fade x' with points held on surfaces, by collocation at Radau's points.
// It serves where fade is so great that an explicit method would take steps of 1 / fade.
// Radau IIA with seven stages has order 13 at a step's end and 7 within it.
// Source: Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, IV.5.
// Sweeps of implicit Euler's method from point to point compute the stages. Each sweep raises the order by one.
// (Spectral deferred correction: Dutt, Greengard & Rokhlin, BIT 40 (2000) 241.)
// The triangular factor of Weiser, BIT 55 (2015) 1219, keeps this so where fade is great. In a sweep drag only makes
// points heavier, by the factor 1 + s fade.

#include "numerics/dense_motion.h"
#include "std.h"

namespace carom {

class RadauCollocation final : public DenseMotion {
 public:
  struct Forces {
    Vec3 pull;    // m/s^2, at the point's position
    double fade;  // 1/s, at least 0
  };
  /// Projects velocities u (m/s) onto those that lead along the surfaces at x (m). In the projection's norm points are
  /// 1 + s fade times as heavy.
  using Hold = function<void(const vector<Vec3>& x, double s, vector<Vec3>& u)>;

  RadauCollocation() : DenseMotion({}, {}) {}  // to be restored
  /// Starts at x (m) and v (m/s).
  RadauCollocation(vector<Vec3> x, vector<Vec3> v) : DenseMotion(std::move(x), std::move(v)) {}

  /// A step of h (s) from the start. It replaces the step before.
  /// Returns the greatest error of a point along an axis, as a share of `position` (m) and `velocity` (m/s). At most 1
  /// is within tolerance.
  double step(double h, span<const Forces> forces, const Hold& hold, double position, double velocity);

  Vec3 displacement(size_t k, double t) const override;
  Vec3 velocity(size_t k, double t) const override;
  PolynomialPath path(size_t k) const override;

  void keep(auto& archive) {
    DenseMotion::keep(archive);
    archive(of_displacement_, of_velocity_);
  }

 private:
  double sweep(span<const Forces> forces, const Hold& hold);
  double interpolate();
  static Vec3 sum(const vector<Vec3>& coefficients, size_t k, double s);

  static constexpr size_t terms = 8;
  vector<vector<Vec3>> at_, speed_, rate_;      // m, m/s, m/s^2: by stage, then by point
  vector<Vec3> of_displacement_, of_velocity_;  // coefficients of Legendre's polynomials, `terms` for each point
};

}  // namespace carom
