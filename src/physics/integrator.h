#pragma once
// Methods that carry particles through a step in time, whatever accelerates them. Each gives the state at the step's
// end and the path between. Cut short at an impact, a step is taken again with the shorter length: the paths of order 1
// and 2 are just where that leads; of order 4 it is Hermite's polynomial through both ends.
#include <cstddef>
#include <cstdint>

#include "physics/path.h"

namespace carom {

enum class Integrator : std::uint8_t {
  euler,   // semi-implicit: v' = v + h a(x, v), x' = x + h v', a kick, then a drift; order 1
  verlet,  // velocity Verlet (Swope et al., J. Chem. Phys. 76 (1982) 637), v' guessed where a depends on it; order 2
  rk4,     // the classical method of Runge and Kutta; order 4
  dop853   // of Dormand and Prince, with steps of its own (dormand_prince.h); order 8; not by take_step
};

/// One step of length h (s) of the particles at x (m) with velocities v (m/s). `accelerate(x, v, a)` fills a (m/s^2).
/// In `end_x` and `end_v` the end of the step, in `path` the way there. `Vectors`: an array or vector of Vec3, its
/// copies as long as itself.
template <typename Vectors, typename Paths, typename Accelerate>
void take_step(Integrator method, double h, const Vectors& x, const Vectors& v, const Accelerate& accelerate,
               Vectors& end_x, Vectors& end_v, Paths& path) {
  const std::size_t n = x.size();
  Vectors a0 = v;
  accelerate(x, v, a0);
  if (method == Integrator::euler) {
    for (std::size_t k = 0; k < n; ++k) {
      end_v[k] = v[k] + h * a0[k];
      end_x[k] = x[k] + h * end_v[k];
      path[k] = {x[k], v[k], 2 * a0[k], Vec3::Zero()};
    }
    return;
  }
  Vectors at = x, speed = v, a1 = v;
  if (method == Integrator::verlet) {
    for (std::size_t k = 0; k < n; ++k) {
      path[k] = {x[k], v[k], a0[k], Vec3::Zero()};
      end_x[k] = x[k] + h * (v[k] + (0.5 * h) * a0[k]);
      speed[k] = v[k] + h * a0[k];
    }
    accelerate(end_x, speed, a1);
    for (std::size_t k = 0; k < n; ++k) end_v[k] = v[k] + (0.5 * h) * (a0[k] + a1[k]);
    return;
  }
  for (std::size_t k = 0; k < n; ++k) {
    at[k] = x[k] + (0.5 * h) * v[k];
    speed[k] = v[k] + (0.5 * h) * a0[k];
  }
  accelerate(at, speed, a1);
  Vectors a2 = v, a3 = v;
  for (std::size_t k = 0; k < n; ++k) {
    at[k] = x[k] + (0.5 * h) * speed[k];
    speed[k] = v[k] + (0.5 * h) * a1[k];
  }
  accelerate(at, speed, a2);
  for (std::size_t k = 0; k < n; ++k) {
    at[k] = x[k] + h * speed[k];
    speed[k] = v[k] + h * a2[k];
  }
  accelerate(at, speed, a3);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 middle = a1[k] + a2[k];
    end_x[k] = x[k] + h * (v[k] + (h / 6) * (a0[k] + middle));
    end_v[k] = v[k] + (h / 6) * (a0[k] + 2 * middle + a3[k]);
    path[k] = {x[k], v[k], (2 * a0[k] + middle - a3[k]) / 3, (a3[k] - a0[k]) / h};
  }
}

}  // namespace carom
