#pragma once
// x'' = a(x, x') of one point under stiff forces, by collocation at Radau's points.
// It serves where an explicit method would take steps of the forces' shortest time (Radau IIA with seven stages; Hairer
// & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, IV.5 and IV.8).
// The order is 13 at a step's end. Within the step it is 7 for the velocity and 8 for the displacement.
// The displacement's polynomial has degree 8, that of PolynomialPath.
#include <Eigen/Core>

#include "numerics/polynomial_path.h"
#include "physics/force_jacobian.h"
#include "std.h"

namespace carom {

class ImplicitStep {
 public:
  /// The acceleration (m/s^2) at x (m) and v (m/s).
  using Acceleration = function<Vec3(const Vec3& x, const Vec3& v)>;
  /// Its derivatives there.
  using Jacobian = function<ForceJacobian(const Vec3& x, const Vec3& v)>;

  /// A step of h (s) from x (m) and v (m/s). It replaces the step before.
  /// Returns the greatest error along an axis at any time of the step, as a share of `position` (m) and `velocity`
  /// (m/s). At most 1 is within tolerance. It is of order 8 in h. Infinity: the stages did not converge.
  double step(double h, const Vec3& x, const Vec3& v, const Acceleration& acceleration, const Jacobian& jacobian,
              double position, double velocity);
  /// The path through the last step.
  PolynomialPath path() const;

 private:
  static constexpr size_t stages = 7;
  struct Newton;

  double error_by_terms() const;
  double error_by_start(const Vec3& a, const ForceJacobian& j) const;

  double length_ = 0;           // s
  Vec3 v_ = Vec3::Zero();       // m/s, at the start
  array<Vec3, stages> change_;  // m/s: change of the velocity since the start, by stage
};

}  // namespace carom
