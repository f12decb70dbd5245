#pragma once
// x'' = a(x, x') of one point under stiff forces, where an explicit method would take steps of a force's shortest time:
// by collocation at Radau's points (Radau IIA with seven stages; Hairer & Wanner, Solving Ordinary Differential
// Equations II, 2nd ed. 1996, IV.5 and IV.8). Order 13 at a step's end. Before it, order 7 of the velocity and 8 of the
// displacement, whose polynomial has degree 8: that of PolynomialPath.
#include <Eigen/Core>
#include <array>
#include <functional>

#include "numerics/polynomial_path.h"
#include "physics/force_jacobian.h"

namespace carom {

class ImplicitStep {
 public:
  /// m/s^2, at x (m) and v (m/s).
  using Acceleration = std::function<Vec3(const Vec3& x, const Vec3& v)>;
  /// Its derivatives there.
  using Jacobian = std::function<ForceJacobian(const Vec3& x, const Vec3& v)>;

  /// A step of h (s) from x (m) and v (m/s), in place of the one before. Gives its greatest error by axis, at any time
  /// of it, as a share of `position` (m) and `velocity` (m/s): at most 1 is good. Infinity: the stages were not found.
  double step(double h, const Vec3& x, const Vec3& v, const Acceleration& acceleration, const Jacobian& jacobian,
              double position, double velocity);
  /// The step (s) after one of h (s) with this error: shorter in its place, or of the next one.
  static double next_length(double h, double error);

  /// The way through the last step.
  PolynomialPath path() const;

 private:
  static constexpr std::size_t stages = 7;
  struct Newton;

  double error_by_terms() const;
  double error_by_start(const Vec3& a, const ForceJacobian& j) const;

  double length_ = 0;                // s
  Vec3 v_ = Vec3::Zero();            // m/s: at the start
  std::array<Vec3, stages> change_;  // m/s: of the velocity since the start, by stage
};

}  // namespace carom
