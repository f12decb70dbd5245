#pragma once
// Methods that carry particles through a step in time under any acceleration.
// Two of them give parabolas, with another acceleration in each step. curved_flights.h applies these.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

enum class Integrator : uint8_t {
  // The method of Dormand and Prince with steps of its own (dormand_prince.h). Order 8.
  dop853,
  // The semi-implicit method: v' = v + h a(x, v), x' = x + h v'. Its path is a parabola that starts with velocity v + h
  // a/2. Order 1.
  euler,
  // Velocity Verlet (Swope et al., J. Chem. Phys. 76 (1982) 637). The path is a parabola from v.
  // At its end the velocity becomes v + h (a + a')/2, a' with the parabola's velocity. Order 2.
  verlet,
  // The classical method of Runge and Kutta. Order 4.
  rk4
};

/// The effect of a step on a particle. `bend` (m): its distance from the straight line at the end. `change` (m/s): the
/// change of its velocity.
struct StepChange {
  Vec3 bend, change;
};

/// A step of the classical method, of length h (s). The particle starts at x (m) with velocity v (m/s) and acceleration
/// a (m/s^2). `acceleration(x, v)` gives the acceleration at other positions and velocities.
template <typename Acceleration>
StepChange runge_kutta(double h, const Vec3& x, const Vec3& v, const Vec3& a, const Acceleration& acceleration) {
  const Vec3 v1 = v + (0.5 * h) * a;
  const Vec3 a1 = acceleration(Vec3(x + (0.5 * h) * v), v1);
  const Vec3 v2 = v + (0.5 * h) * a1;
  const Vec3 a2 = acceleration(Vec3(x + (0.5 * h) * v1), v2);
  const Vec3 v3 = v + h * a2;
  const Vec3 a3 = acceleration(Vec3(x + h * v2), v3);
  const Vec3 middle = a1 + a2;
  return {(h * h / 6) * (a + middle), (h / 6) * (a + 2 * middle + a3)};
}

}  // namespace carom
