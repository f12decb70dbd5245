#pragma once
// x'' = pull - fade x' + what keeps points on surfaces, where fade is so great that an explicit method would take steps
// of 1 / fade: by collocation at Radau's points (Radau IIA with nine stages, order 17 at a step's end and 9 within it;
// Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, IV.5). The stages are found by sweeps of
// implicit Euler's method from point to point, each of which makes the last one's values better by an order (spectral
// deferred correction: Dutt, Greengard & Rokhlin, BIT 40 (2000) 241; with the triangular factor of Weiser, BIT 55
// (2015) 1219, also where fade is great). In a sweep drag only makes points heavier: 1 + s fade times as heavy.
#include <functional>
#include <span>
#include <vector>

#include "numerics/dense_motion.h"

namespace carom {

class RadauCollocation final : public DenseMotion {
 public:
  struct Forces {
    Vec3 pull;    // m/s^2, where a point stands
    double fade;  // 1/s, at least 0
  };
  /// Brings velocities u (m/s) to the nearest ones that lead along the surfaces at x (m), where points are 1 + s fade
  /// times as heavy.
  using Hold = std::function<void(const std::vector<Vec3>& x, double s, std::vector<Vec3>& u)>;

  /// From x (m) and v (m/s).
  RadauCollocation(std::vector<Vec3> x, std::vector<Vec3> v) : DenseMotion(std::move(x), std::move(v)) {}

  /// A step of h (s) from the start, in place of the one before. Gives its greatest error by point and axis, as a share
  /// of `position` (m) and `velocity` (m/s): at most 1 is good.
  double step(double h, std::span<const Forces> forces, const Hold& hold, double position, double velocity);

  Vec3 displacement(std::size_t k, double t) const override;
  Vec3 velocity(std::size_t k, double t) const override;

 private:
  double sweep(std::span<const Forces> forces, const Hold& hold);
  double interpolate();
  static Vec3 sum(const std::vector<Vec3>& coefficients, std::size_t k, double s);

  static constexpr std::size_t terms = 10;
  std::vector<std::vector<Vec3>> at_, speed_, rate_;  // m, m/s, m/s^2: by stage, by point
  std::vector<Vec3> of_displacement_, of_velocity_;   // of Legendre's polynomials, `terms` by point
};

}  // namespace carom
