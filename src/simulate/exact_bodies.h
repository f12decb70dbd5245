#pragma once
// What the parts of the exact simulator share: the World, the clock, where the bodies are and what forces do to them,
// and the log.
//
// Each body keeps its Flight and is not moved when others collide. Each body keeps one event, the first of its own; the
// first of all of these is the next thing to happen. A predicted collision is a function of the two flights alone. So
// it has the same bits from whichever side, and whenever, it is computed: neither outputs nor the search for neighbours
// can change it.
#include <vector>

#include "geometry/touch.h"
#include "physics/bounds.h"
#include "simulate/event_log.h"
#include "simulate/exact.h"
#include "simulate/exact_event.h"
#include "simulate/flight.h"
#include "simulate/islands.h"
#include "simulate/large_pages.h"
#include "simulate/lazy_array.h"
#include "simulate/merged_bodies.h"
#include "simulate/neighbours.h"
#include "simulate/tolerances.h"

namespace carom {

struct ExactBodies {
  /// `given` must outlive this.
  ExactBodies(const World& given, const ExactOptions& given_options);

  const ExactOptions options;
  MergedBodies merged;
  const World& world;  // with the joint bodies' masses and volumes
  const Bounds bounds;
  const bool same_radius;  // of all bodies, for good
  const bool varying;      // some force bends paths (force.h)
  const bool by_method;    // paths that bend are the integrator's, also where they have a closed form
  const bool in_steps;     // or a method is asked for: some flight may be curved
  Instant now;
  LazyArray<Vec3> applied;       // m/s^2, by body: gravity and the forces of now, on a body that stands,
  LazyArray<double> fade;        // 1/s: this, times its velocity, linear drag takes from both
  LazyArray<std::uint8_t> bent;  // forces that bend paths act on it: all of these are as they were last looked at
  Flights flights;
  LargeVector<ExactBody> body;
  Neighbours neighbours;
  Islands islands;
  EventLog log;

  /// Throws SimulationError unless body i's place x (m) and velocity v (m/s) at `time` (s) are within bounds.
  void hold_to_bounds(Entity i, double time, const Vec3& x, const Vec3& v) const {
    if (!bounds.hold(x, v)) [[unlikely]]
      fail_out_of_bounds(bounds, i, time, x, v, remedies());
  }
  static constexpr double immovable = never;  // kg

  Vec3 position(Entity i) const { return flights[i].position(now - flights[i].start); }  // m, now
  /// m/s, now, as in its flight: with what time stepping has kicked it by.
  Vec3 velocity(Entity i) const { return flights[i].velocity(now - flights[i].start); }
  /// m/s, at an instant of its flight, without what forces do later, and with what curved surfaces have done since.
  Vec3 velocity_without_kick(Entity i, const Instant& at) const;
  /// m/s^2, what forces do to body i at x (m) and v (m/s).
  Vec3 force_at(Entity i, const Vec3& x, const Vec3& v) const {
    if (bent[i]) [[unlikely]]
      return bent_force_at(i, x, v);
    return fade[i] == 0 ? applied[i] : Vec3(applied[i] - fade[i] * v);
  }
  /// Body i's forces are these from now on.
  void apply(Entity i, const AppliedAcceleration& forces);
  /// Those that act now, on body i at x (m) and v (m/s).
  void apply_forces(Entity i, const Vec3& x, const Vec3& v);
  /// Whether body i's flights, when free, are steps of a method.
  bool flies_in_steps(Entity i) const { return bent[i] != 0 || (by_method && method_bends(i)); }
  /// Looks at them again, if they vary with these.
  void refresh(Entity i, const Vec3& x, const Vec3& v) {
    if (bent[i]) [[unlikely]]
      apply_forces(i, x, v);
  }
  /// When body i's flight ends at the latest: at the end of a step, its own or its island's.
  Instant flight_end(Entity i) const;
  /// m: where a body is now, or a fixed thing.
  Vec3 position_of(Entity e) const { return world.is_body(e) ? position(e) : world.fixed_position(e); }

  bool in_group(Entity i) const { return body[i].state == ContactState::group; }
  /// Whether body i's island moves by constrained motion, or by time stepping.
  bool is_constrained(Entity i) const { return in_group(i) && islands.of(i).constrained; }
  bool is_stepped(Entity i) const { return in_group(i) && !islands.of(i).constrained; }
  /// Whether e is a body of the contact group, or asleep.
  bool in_lasting_contact(Entity e) const { return world.is_body(e) && body[e].state != ContactState::free; }

  /// Two bodies now.
  struct PairState {
    Vec3 xa, va, xb, vb;  // m, m/s
  };
  /// Whether a body at x (m) is so far from the origin that its place tells less of what lies beside it than relative
  /// paths do.
  bool far_from_origin(Entity i, const Vec3& x) const {
    return x.cwiseAbs().maxCoeff() > exact_tolerance::far_from_origin * world.radius[i];
  }
  /// Bodies a and b now, in the frame of a: by their relative path, from which what they have in common takes no
  /// digits.
  PairState in_frame_of(Entity a, Entity b) const;

  /// Bodies and fixed things near body i, ascending: what is summed up in this order is the same for any lists.
  std::vector<Entity> known_to(Entity i) const;
  /// How a and b touch at xa, xb (m), having just met at this feature.
  Touch touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature) const;

  /// The acceleration (m/s^2) with which body i may press on others. In common free fall, nothing fixed and no other
  /// forces, there is none: gravity moves all alike.
  double load_on(Entity i) const;
  /// The speed (m/s) under which impacts in lasting contact no longer count one by one: rest_speed, or by default a
  /// share of the speed gained over `length` (m) at the pressing acceleration (m/s^2).
  double slow_speed(double press, double length) const;
  /// m, by which two things are slow: the diameter of the smaller one, the radius of a body on something fixed.
  double smaller_length(Entity i, Entity e) const {
    return world.is_body(e) ? 2 * std::min(world.radius[i], world.radius[e]) : world.radius[i];
  }
  /// m/s: a speed as good as none, for products of it with itself underflow.
  double negligible_speed() const { return exact_tolerance::negligible_speed * log.tally().max_speed; }
  /// Whether a speed (m/s) against a pressing acceleration (m/s^2) lifts a body by less than its position x (m) is
  /// rounded to.
  static bool too_low(const Vec3& x, double speed, double press) {
    return speed * speed < press * exact_tolerance::position_rounding * x.cwiseAbs().sum();
  }

  /// Whether body i's elastic hops, of this speed (m/s) against a pressing acceleration (m/s^2), are as good as over:
  /// drag shortens them, ever more in a second.
  bool hops_fade(Entity i, double speed, double press) const;

 private:
  bool method_bends(Entity i) const;
  Remedies remedies() const;
  Vec3 bent_force_at(Entity i, const Vec3& x, const Vec3& v) const;
};

}  // namespace carom
