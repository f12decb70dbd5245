#pragma once
// x'' = a(x, x') of many points by the method DOP853: order 8 with an error estimate of orders 5 and 3, and a dense
// output of order 7 (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, II.5 and II.6;
// the coefficients are those of their program). Twelve accelerations a step, and three more for the dense output.
#include <functional>
#include <vector>

#include "numerics/dense_motion.h"
#include "numerics/polynomial_path.h"

namespace carom {

class DormandPrince final : public DenseMotion {
 public:
  /// m/s^2, by point, at these positions (m) and velocities (m/s).
  using Acceleration = std::function<std::vector<Vec3>(const std::vector<Vec3>& x, const std::vector<Vec3>& v)>;

  /// From x (m) and v (m/s), where the acceleration is a (m/s^2).
  DormandPrince(std::vector<Vec3> x, std::vector<Vec3> v, std::vector<Vec3> a);

  /// A step of h (s) from the start, in place of the one before. Gives its greatest error by point and axis, as a share
  /// of `position` (m) and `velocity` (m/s): at most 1 is good.
  double step(double h, const Acceleration& acceleration, double position, double velocity);
  /// The step (s) after one of h (s) with this error: shorter in its place, or of the next one.
  static double next_length(double h, double error);

  /// Prepares displacement() and velocity() for the last step. Before its end they are exact to order 7.
  void interpolate(const Acceleration& acceleration);
  Vec3 displacement(std::size_t k, double t) const override;
  Vec3 velocity(std::size_t k, double t) const override;
  /// Point k's way through the step.
  PolynomialPath path(std::size_t k) const;

 private:
  static constexpr std::size_t stages = 16, terms = 7;

  void evaluate(std::size_t stage, const Acceleration& acceleration);
  static Vec3 polynomial(const std::vector<Vec3>& coefficients, std::size_t k, double s);

  std::vector<Vec3> velocity_[stages], rate_[stages];  // m/s, m/s^2: of each stage
  std::vector<Vec3> of_displacement_, of_velocity_;    // coefficients of the dense output, `terms` by point
};

}  // namespace carom
