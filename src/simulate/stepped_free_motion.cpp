#include "simulate/stepped_free_motion.h"

#include <array>

#include "physics/contact_time.h"

namespace carom {

FreeMotion::FreeMotion(const World& world, const SteppedOptions& options, const StepClock& clock)
    : world_(world),
      clock_(clock),
      integrator_(options.integrator),
      loaded_(!world.gravity.isZero(0) || !world.forces.empty()) {
  for (const Force& force : world.forces) {
    constant_ = constant_ && is_constant(force.law);
    works_ = works_ || force.from > 0 || force.until < never || !is_constant(force.law);
  }
}

void FreeMotion::carry(Entity i, double length, Vec3& x, Vec3& v, Path& path) const {
  if (!constant_) return carry_by_method(i, length, x, v, path);
  // The methods under constant forces, in closed form.
  const Vec3 a = acceleration(i, x, v);
  const bool euler = integrator_ == Integrator::euler;
  path = {x, v, euler ? Vec3(2 * a) : a, Vec3::Zero()};
  x = path.position(length);
  v += length * a;
}

void FreeMotion::carry_by_method(Entity i, double length, Vec3& x, Vec3& v, Path& path) const {
  using One = std::array<Vec3, 1>;
  One from_x{x}, from_v{v}, end_x, end_v;
  std::array<Path, 1> paths;
  take_step(
      integrator_, length, from_x, from_v,
      [&](const One& at, const One& speed, One& a) { a[0] = acceleration(i, at[0], speed[0]); }, end_x, end_v, paths);
  x = end_x[0];
  v = end_v[0];
  path = paths[0];
}

double FreeMotion::work(Entity i, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double length) const {
  const auto power = [&](const Vec3& at, const Vec3& speed) {
    return world_.mass[i] * working_acceleration(world_, i, clock_.from(), at, speed).dot(speed);
  };
  const Vec3 middle_x = 0.5 * (x0 + x1) + (length / 8) * (v0 - v1);
  const Vec3 middle_v = (1.5 / length) * (x1 - x0) - 0.25 * (v0 + v1);
  return length / 6 * (power(x0, v0) + 4 * power(middle_x, middle_v) + power(x1, v1));
}

}  // namespace carom
