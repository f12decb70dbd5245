#pragma once
// x'' = a(x, x') of many points by the method DOP853: order 8, an error estimate of orders 5 and 3, dense output of
// order 7. Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, II.5 and II.6.
// The coefficients are those of their program. A step takes twelve accelerations, and three more for the dense output.

#include "numerics/dense_motion.h"
#include "numerics/polynomial_path.h"
#include "std.h"

namespace carom {

class DormandPrince final : public DenseMotion {
 public:
  /// The acceleration (m/s^2) of each point at these positions (m) and velocities (m/s).
  using Acceleration = function<vector<Vec3>(const vector<Vec3>& x, const vector<Vec3>& v)>;

  DormandPrince() : DenseMotion({}, {}) {}  // to be restored
  /// Starts at x (m) and v (m/s), where the acceleration is a (m/s^2).
  DormandPrince(vector<Vec3> x, vector<Vec3> v, vector<Vec3> a);

  /// A step of h (s) from the start. It replaces the step before.
  /// Returns the greatest error of a point along an axis, as a share of `position` (m) and `velocity` (m/s). At most 1
  /// is within tolerance.
  double step(double h, const Acceleration& acceleration, double position, double velocity);
  /// The same with errors of each point's own.
  double step(double h, const Acceleration& acceleration, span<const double> position, span<const double> velocity);
  /// The step length (s) after a step of h (s) with this error, of order 8 in h. After a rejected step it is the length
  /// of the retry.
  static double next_length(double h, double error);

  /// Prepares displacement() and velocity() for the last step. Within the step both are right to order 7.
  void interpolate(const Acceleration& acceleration);
  Vec3 displacement(size_t k, double t) const override;
  Vec3 velocity(size_t k, double t) const override;
  PolynomialPath path(size_t k) const override;

  void keep(auto& archive) {
    DenseMotion::keep(archive);
    archive(of_displacement_, of_velocity_);
  }

 private:
  static constexpr size_t stages = 16, terms = 7;

  void evaluate(size_t stage, const Acceleration& acceleration);
  void evaluate_all(double h, const Acceleration& acceleration);
  template <typename Position, typename Velocity>
  double greatest_error(Position position, Velocity velocity) const;
  static Vec3 polynomial(const vector<Vec3>& coefficients, size_t k, double s);

  vector<Vec3> velocity_[stages], rate_[stages];  // m/s and m/s^2, of each stage
  vector<Vec3> of_displacement_, of_velocity_;    // coefficients of the dense output, `terms` for each point
};

}  // namespace carom
