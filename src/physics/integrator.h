#pragma once
// Methods that carry particles through a step in time, whatever accelerates them. Two are parabolas, from step to step
// with another acceleration: curved_flights.h has them.
#include <cstdint>

#include "numerics/vec3.h"

namespace carom {

enum class Integrator : std::uint8_t {
  euler,   // semi-implicit: v' = v + h a(x, v), x' = x + h v': a parabola, as fast as v + h a/2 at first; order 1
  verlet,  // velocity Verlet (Swope et al., J. Chem. Phys. 76 (1982) 637): at the end of a parabola from v, the
           // velocity goes over to v + h (a + a')/2, a' with the parabola's velocity; order 2
  rk4,     // the classical method of Runge and Kutta; order 4
  dop853   // of Dormand and Prince, with steps of its own (dormand_prince.h); order 8
};

/// What a step does to a particle: `bend` (m), how far it is off the straight line at its end, and `change` (m/s), of
/// its velocity.
struct StepChange {
  Vec3 bend, change;
};

/// A step by the classical method of length h (s) of a particle at x (m) with velocity v (m/s) and acceleration a
/// (m/s^2) there. `acceleration(x, v)` gives that of other places and velocities.
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
