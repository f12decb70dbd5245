#pragma once
// The data that the parts of the exact simulator share: the World, the clock, the bodies' flights, the forces on them,
// and the log.
//
// Each body keeps its Flight and is not moved when others collide. Each body keeps one event, the first of its own. The
// first of all these is the next event. A predicted collision is a function of the two flights alone. It has the same
// bits from either side and at any time of prediction. Neither outputs nor the search for neighbours can therefore
// change it.
#include <algorithm>
#include <span>
#include <vector>

#include "geometry/touch.h"
#include "physics/bounds.h"
#include "simulate/contact_work.h"
#include "simulate/event_log.h"
#include "simulate/exact.h"
#include "simulate/exact_event.h"
#include "simulate/flight.h"
#include "simulate/islands.h"
#include "simulate/large_pages.h"
#include "simulate/lazy_array.h"
#include "simulate/merged_bodies.h"
#include "simulate/moving_things.h"
#include "simulate/neighbours.h"
#include "simulate/ties.h"
#include "simulate/tolerances.h"

namespace carom {

struct ExactBodies {
  /// `given` must outlive this object.
  ExactBodies(const World& given, const ExactOptions& given_options);

  const ExactOptions options;
  MergedBodies merged;
  const World& world;  // with the joint bodies' masses and volumes
  const MovingThings moving;
  Ties ties;
  const Bounds bounds;
  const bool same_radius;  // all bodies have one radius throughout the run
  const bool varying;      // some force bends paths (force.h)
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
  LazyArray<std::uint8_t> bent;
  Flights flights;
  LazyArray<Kick> kick;  // by body, in its velocity while it is fresh or stepped
  LargeVector<ExactBody> body;
  Neighbours neighbours;
  Islands islands;
  EventLog log;
  ContactWork contact_work;

  /// Throws SimulationError unless body i's position x (m) and velocity v (m/s) at `time` (s) are within bounds.
  void hold_to_bounds(Entity i, double time, const Vec3& x, const Vec3& v) const {
    if (!bounds.hold(x, v)) [[unlikely]]
      fail_out_of_bounds(bounds, i, time, x, v, remedies());
  }
  /// Throws SimulationError: these things, of which one moves, leave body i no room.
  [[noreturn]] void fail_squeezed(Entity i, std::vector<Entity> things) const;
  static constexpr double immovable = never;  // kg

  Vec3 position(Entity i) const { return flights[i].position(now - flights[i].start); }  // m, at present
  /// The present velocity in its flight (m/s), with the kick of time stepping.
  Vec3 velocity(Entity i) const { return flights[i].velocity(now - flights[i].start); }
  /// The velocity at an instant of its flight (m/s), without the effect of forces later in a step.
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
  [[gnu::always_inline]] void note_speed(Entity i, const Vec3& v) {
    if (log.tally().fastest.speed < v.norm()) [[unlikely]]
      note_greatest_speed(i, v);
  }
  /// Evaluates them again, if they vary with x (m) and v (m/s).
  void refresh(Entity i, const Vec3& x, const Vec3& v) {
    if (bent[i]) [[unlikely]]
      apply_forces(i, x, v);
  }
  /// The latest end of body i's flight: the end of a step of its own or of its island.
  [[gnu::always_inline]] Instant flight_end(Entity i) const {
    Instant end{never, 0};
    if (is_member(mode(i))) end = islands.of(i).end;
    if (const PolynomialPath* curve = flights.curve(i)) end = std::min(end, flights[i].start + curve->length);
    return end;
  }
  // A thing is what a body meets: another body, a fixed thing, or a string. A string is at its other end: a body, or an
  // anchor, which is as a fixed thing.
  /// The present position (m) and velocity (m/s) of a thing, and the acceleration of its path (m/s^2).
  Vec3 position_of(Entity thing) const {
    const Entity body = world.second_body(thing);
    return body != no_entity ? position(body) : fixed_position(thing);
  }
  Vec3 velocity_of(Entity thing) const {
    const Entity body = world.second_body(thing);
    return body != no_entity ? velocity(body) : fixed_velocity(thing);
  }
  Vec3 pull_of(Entity thing) const {
    const Entity body = world.second_body(thing);
    return body != no_entity ? flights[body].acceleration(now - flights[body].start) : Vec3(Vec3::Zero());
  }
  /// The present velocity of a thing (m/s), without the effect of forces later in a step.
  Vec3 unkicked_velocity_of(Entity thing) const {
    const Entity body = world.second_body(thing);
    return body != no_entity ? velocity_without_kick(body, now) : fixed_velocity(thing);
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
  /// Whether body i cannot strike a fixed thing, because it lies behind a flat surface of normal n, towards the body,
  /// that moves at this velocity (m/s) and carries the body. A thing that comes out of the surface is not hidden.
  bool hidden(Entity i, const Vec3& x, Entity fixed, const Vec3& n, const Vec3& velocity) const {
    if (moving.any() && n.dot(moving.velocity(fixed, now) - velocity) > 0) return false;
    return lies_behind(world, i, x, fixed, fixed_position(fixed), n);
  }

  /// What moves body i now.
  [[gnu::always_inline]] Mode mode(Entity i) const { return body[i].mode(); }

  /// Present positions and velocities of two bodies.
  struct PairState {
    Vec3 xa, va, xb, vb;  // m, m/s
  };
  /// Whether a body at x (m) is far from the origin. Its position then resolves its surroundings less well than
  /// relative paths do.
  bool far_from_origin(Entity i, const Vec3& x) const {
    return x.cwiseAbs().maxCoeff() > exact_tolerance::far_from_origin * world.radius[i];
  }
  /// Bodies a and b at present, in the frame of a. Their relative path is used, so that the common motion costs no
  /// digits.
  PairState in_frame_of(Entity a, Entity b) const;

  /// Bodies and fixed things near body i, ascending. Sums in this order do not depend on the order of the lists.
  std::vector<Entity> neighbours_of(Entity i) const;
  /// The contact of a string's body with it, at present.
  Touch string_now(Entity string) const;
  /// Whether a string between bodies in lasting contact is taut, and its length does not change but for rounding. A rod
  /// always is.
  bool holds(Entity string) const;
  /// The same for any bodies. `near`: m, a gap that counts as taut if it is more than that of a contact.
  bool keeps_length(Entity string, double near) const;
  /// Whether a string is as long as it can be, but for rounding. A rod always is.
  bool is_taut(Entity string) const;
  /// Whether one of these bodies has a taut string, or a rod.
  bool any_taut(std::span<const Entity> those) const;
  /// Whether one of these bodies approaches what it touches, or the length of a taut string or of a rod, by more than
  /// rounding.
  bool any_meets(std::span<const Entity> those) const;
  /// The contact of a and b at xa, xb (m), which have just met at this feature.
  Touch touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature) const;

  /// Whether nothing presses on body i, and constant forces alone move it.
  bool falls_freely(Entity i) const {
    return bent[i] == 0 && fade[i] == 0 && flights.curve(i) == nullptr && flights.acceleration(i) == applied[i];
  }
  /// The largest gap between body i, at x, and a thing at xe that counts as contact (m).
  double contact_gap(Entity i, const Vec3& x, const Vec3& xe) const;
  /// The speed (m/s) along the normal of body i and a thing in lasting contact, at v and ve, that is the method's
  /// error.
  double drift_of(Entity i, const Vec3& v, const Vec3& ve) const;

  /// The speed (m/s) below which impacts in lasting contact do not count one by one. It is rest_speed.
  /// By default it is a share of the speed gained over `length` (m) at the pressing acceleration (m/s^2).
  double slow_speed(double press, double length) const;
  /// The length on which two things are slow (m): the diameter of the smaller one, or the radius of a body on a fixed
  /// thing.
  double smaller_length(Entity i, Entity e) const {
    const Entity second = world.second_body(e);
    return second != no_entity ? 2 * std::min(world.radius[i], world.radius[second]) : world.radius[i];
  }
  /// A speed that counts as zero (m/s), because its square would underflow.
  double negligible_speed() const { return exact_tolerance::negligible_speed * log.tally().fastest.speed; }
  /// Whether a speed (m/s) against a pressing acceleration (m/s^2) lifts a body by less than the rounding of its
  /// position x (m).
  static bool too_low(const Vec3& x, double speed, double press) {
    return speed * speed < press * exact_tolerance::position_rounding * x.cwiseAbs().sum();
  }

  /// Whether body i's elastic hops at this speed (m/s), against a pressing acceleration (m/s^2), count as over. Drag
  /// shortens them, ever more of them in a second.
  bool hops_fade(Entity i, double speed, double press) const;

 private:
  [[gnu::noinline]] void note_greatest_speed(Entity i, const Vec3& v);
  bool method_bends(Entity i) const;
  Remedies remedies() const;
  Vec3 bent_force_at(Entity i, const Vec3& x, const Vec3& v) const;
};

}  // namespace carom
