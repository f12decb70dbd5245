#pragma once
// The motion of bodies that touch nothing, through a step or a part of one.
#include "physics/force.h"
#include "physics/integrator.h"
#include "physics/path.h"
#include "physics/world.h"
#include "simulate/stepped.h"
#include "simulate/stepped_clock.h"

namespace carom {

class FreeMotion {
 public:
  /// `world` and `clock` must outlive this.
  FreeMotion(const World& world, const SteppedOptions& options, const StepClock& clock);

  /// m/s^2, of body i at x (m) and v (m/s) in the present step.
  Vec3 acceleration(Entity i, const Vec3& x, const Vec3& v) const {
    return world_.forces.empty() ? world_.gravity : free_acceleration(world_, i, clock_.from(), x, v);
  }
  /// Carries body i on for `length` (s): x (m) and v (m/s) in and out, `path` between.
  void carry(Entity i, double length, Vec3& x, Vec3& v, Path& path) const;
  /// J, what forces without a potential do on a path of `length` (s) from x0, v0 to x1, v1 (m, m/s). By Simpson's rule,
  /// with the middle of Hermite's polynomial through both ends.
  double work(Entity i, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double length) const;

  Integrator integrator() const { return integrator_; }
  bool loaded() const { return loaded_; }      // there is gravity, or a force
  bool constant() const { return constant_; }  // all forces are constant
  bool works() const { return works_; }        // some force does work (force.h)

 private:
  void carry_by_method(Entity i, double length, Vec3& x, Vec3& v, Path& path) const;

  const World& world_;
  const StepClock& clock_;
  const Integrator integrator_;
  const bool loaded_;
  bool constant_ = true, works_ = false;
};

}  // namespace carom
