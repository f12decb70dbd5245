#pragma once
// Maxwell's distribution of the speeds of bodies in equilibrium, in one, two or three dimensions.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The density of speeds in s/m: d/2 degrees of freedom give v^(d-1) exp(-v^2 / (2 s^2)), normalised over v >= 0.
/// `speed` v in m/s; `dimensions` d is 1, 2 or 3.
/// `deviation` s in m/s is that of each component of the velocity: s^2 = k T / m, and the mean of v^2 is d s^2.
double maxwell_density(double speed, int dimensions, double deviation);

/// The kinetic energy of bodies as the matrix of the sums of m v_i v_j, twice the energy by directions.
class EnergyByDirection {
 public:
  void add(double mass, const Vec3& velocity);  // kg, m/s
  /// J, of all bodies.
  double kinetic() const { return (sum_[0] + sum_[1] + sum_[2]) / 2; }
  /// The number of directions, not necessarily along the axes, in which bodies move: the rank, 0 to 3.
  /// A direction with less than 10^-12 of the energy does not count, because rounding leaves that much.
  int dimensions() const;

 private:
  array<double, 6> sum_{};  // xx, yy, zz, xy, xz, yz; J
};

}  // namespace carom
