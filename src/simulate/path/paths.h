#pragma once
// The paths of all bodies: the World, the clock, each body's flight, the forces on it, and the log.
//
// Each body keeps its Flight and is not moved when others collide. A path is known between two events. Neither outputs
// nor the search for neighbours can change it.

#include "numerics/large_pages.h"
#include "numerics/lazy_array.h"
#include "physics/bounds.h"
#include "simulate/event_log.h"
#include "simulate/exact.h"
#include "simulate/path/couplings.h"
#include "simulate/path/exact_event.h"
#include "simulate/path/flight.h"
#include "simulate/path/merged_bodies.h"
#include "simulate/path/modes.h"
#include "simulate/path/moving_things.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

struct BodyPaths {
  /// `given` must outlive this object.
  BodyPaths(const World& given, const ExactOptions& given_options);

  const ExactOptions options;
  MergedBodies merged;
  Couplings couplings;
  const World& world;  // with the joint bodies' masses and volumes
  const MovingThings moving;
  const Bounds bounds;
  const bool forced;   // there are forces beside gravity, or between bodies, or strings that are cut
  const bool varying;  // some force bends paths (force.h)
  // The integrator gives all paths that bend, also those with a closed form.
  const bool by_method;
  // Some flight may be curved, because forces vary or a method is chosen.
  const bool in_steps;
  Instant now;
  // m/s^2, by body: gravity and present forces on a body at rest.
  LazyArray<Vec3> applied;
  // 1/s, by body: linear drag takes this rate times the velocity from the acceleration.
  LazyArray<double> fade;
  // By body: whether forces that bend paths act on it. All three are values of the last evaluation.
  LazyArray<uint8_t> bent;
  Flights flights;
  LazyArray<Kick> kick;  // by body, of its drift while it is stepped
  LargeVector<ExactBody> body;
  EventLog log;

  void keep(auto& archive) {
    archive(merged, couplings, now, applied, fade, bent, flights, kick);
    archive.sized(body);
    archive(log);
  }

  /// What moves body i now.
  Mode mode(Entity i) const { return body[i].mode(); }

  /// Throws SimulationError unless body i's position x (m) and velocity v (m/s) at `time` (s) are within bounds.
  void hold_to_bounds(Entity i, double time, const Vec3& x, const Vec3& v) const {
    if (!bounds.contain(x, v)) [[unlikely]]
      fail_out_of_bounds(bounds, i, time, x, v, remedies());
  }

  Vec3 position(Entity i) const { return flights[i].position(now - flights[i].start); }  // m, at present
  /// The present velocity in its flight (m/s), in a crowd that of the drift.
  Vec3 velocity(Entity i) const { return flights[i].velocity(now - flights[i].start); }
  /// The velocity at an instant of its flight (m/s), in a crowd not that of the drift.
  Vec3 velocity_without_kick(Entity i, const Instant& at) const;
  /// The acceleration of body i by forces at x (m) and v (m/s), in m/s^2.
  Vec3 force_at(Entity i, const Vec3& x, const Vec3& v) const {
    if (bent[i]) [[unlikely]]
      return bent_force_at(i, x, v);
    return fade[i] == 0 ? applied[i] : Vec3(applied[i] - fade[i] * v);
  }
  /// Sets body i's forces from the present instant on.
  void apply(Entity i, const AppliedAcceleration& forces);
  /// Sets them to those that act at present, on body i at x (m) and v (m/s).
  void apply_forces(Entity i, const Vec3& x, const Vec3& v);
  /// The first time (s) after `time` at which a force on body i starts or ends.
  double next_switch(Entity i, double time) const {
    return min(merged.next_switch(i, time), couplings.next_switch(i, time));
  }
  /// Whether forces between bodies act on body i now.
  bool is_coupled(Entity i) const { return couplings.any() && couplings.act_on(i, now.floor()); }
  /// Whether body i's flights, when free, are steps of a method.
  bool flies_in_steps(Entity i) const { return bent[i] != 0 || (by_method && method_bends(i)); }
  /// Whether body i's present flight is a curve of its own. A path of constrained motion is not.
  bool flies_on_curve(Entity i) const { return flights.curve(i) != nullptr && mode(i) != Mode::held; }
  /// The same, also where such a flight has just ended.
  bool path_bends(Entity i) const { return flies_on_curve(i) || (flies_in_steps(i) && is_free(mode(i))); }
  /// What Verlet's method adds to the velocity (m/s) in `t` s of body i's flight: the accelerations of its two ends
  /// count alike.
  Vec3 verlet_change(Entity i, const Flight& f, double t) const {
    return (0.5 * t) * (force_at(i, f.position(t), f.velocity(t)) - f.a);
  }
  /// The velocity by the scene's method within the first `length` (s) of body i's flight on a curve. Verlet's
  /// acceleration is linear between the two ends.
  VelocityBeyond beyond_curve(Entity i, const Flight& f, double length) const;
  /// Notes the speed of body i, at velocity v (m/s) of its present flight.
  void note_speed(Entity i, const Vec3& v) {
    if (log.tally().fastest.speed < v.norm()) [[unlikely]]
      note_greatest_speed(i, v);
  }
  /// Evaluates them again, if they vary with x (m) and v (m/s).
  void refresh(Entity i, const Vec3& x, const Vec3& v) {
    if (bent[i]) [[unlikely]]
      apply_forces(i, x, v);
  }

  /// Whether nothing presses on body i, and constant forces alone move it.
  bool falls_freely(Entity i) const {
    return bent[i] == 0 && fade[i] == 0 && flights.curve(i) == nullptr && flights.acceleration(i) == applied[i];
  }

  // A thing is what a body meets: another body, a fixed thing, or a string. A string is at its end away from
  // String::body: at a body, or at an anchor, which is as a fixed thing.
  /// The present position (m) and velocity (m/s) of a thing, and the acceleration of its path (m/s^2).
  [[gnu::always_inline]] Vec3 position_of(Entity thing) const {
    const Entity i = world.second_body(thing);
    return i != no_entity ? position(i) : fixed_position(thing);
  }
  Vec3 velocity_of(Entity thing) const {
    const Entity i = world.second_body(thing);
    return i != no_entity ? velocity(i) : fixed_velocity(thing);
  }
  Vec3 pull_of(Entity thing) const {
    const Entity i = world.second_body(thing);
    return i != no_entity ? flights[i].acceleration(now - flights[i].start) : fixed_acceleration(thing, now);
  }
  /// The position (m) and velocity (m/s) of a fixed thing, at present or at an instant.
  Vec3 fixed_position(Entity e) const { return fixed_position(e, now); }
  Vec3 fixed_velocity(Entity e) const { return fixed_velocity(e, now); }
  Vec3 fixed_position(Entity e, const Instant& at) const {
    return moving.any() ? moving.position(e, at) : world.fixed_position(e);
  }
  Vec3 fixed_velocity(Entity e, const Instant& at) const {
    return moving.any() ? moving.velocity(e, at) : Vec3(Vec3::Zero());
  }
  /// Its acceleration (m/s^2) at an instant.
  Vec3 fixed_acceleration(Entity e, const Instant& at) const {
    return moving.any() ? moving.acceleration(e, at) : Vec3(Vec3::Zero());
  }

 private:
  [[gnu::noinline]] void note_greatest_speed(Entity i, const Vec3& v);
  bool method_bends(Entity i) const;
  Remedies remedies() const;
  Vec3 bent_force_at(Entity i, const Vec3& x, const Vec3& v) const;
};

}  // namespace carom
