#pragma once
// The data that the parts of the exact simulator share: the paths of bodies, their neighbours and contacts.
//
// Each body keeps one event, the first of its own. The first of all these is the next event. A predicted collision is a
// function of the two flights alone. It has the same bits from either side and at any time of prediction.

#include "geometry/touch.h"
#include "simulate/contact/contact_work.h"
#include "simulate/contact/islands.h"
#include "simulate/contact/ties.h"
#include "simulate/path/paths.h"
#include "simulate/space/neighbours.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

/// The paths of bodies, and what their contacts need.
struct ExactBodies : BodyPaths {
  /// `given` must outlive this object.
  ExactBodies(const World& given, const ExactOptions& given_options);

  const bool same_radius;  // all bodies have one radius throughout the run
  Ties ties;
  Neighbours neighbours;
  Islands islands;
  ContactWork contact_work;

  void keep(auto& archive) {
    BodyPaths::keep(archive);
    archive(ties, neighbours, islands, touches_nothing);
  }

  static constexpr double immovable = never;  // kg

  // By body: its island holds it by forces between bodies alone, and nothing touches it.
  LazyArray<uint8_t> touches_nothing;
  /// The first time (s) after `time` at which a force on body i starts or ends, or a string of it is cut.
  double next_switch(Entity i, double time) const {
    return min(BodyPaths::next_switch(i, time), ties.next_cut(i, time));
  }
  /// Whether body i is in lasting contact with a thing.
  bool in_contact(Entity i) const { return in_lasting_contact(mode(i)) && touches_nothing[i] == 0; }
  /// Adds the accelerations by forces between these bodies, which have all that they connect, to those of forces on
  /// each of them (`applied`). They are in ascending order, at x (m) with velocities v (m/s). Returns these forces.
  CoupledForces apply_couplings(span<const Entity> those, span<const Vec3> x, span<const Vec3> v);
  /// Whether forces between bodies act on one of these now.
  bool any_coupled(span<const Entity> those) const {
    return couplings.any() && any_of(those, [&](Entity i) { return is_coupled(i); });
  }

  /// Throws SimulationError: these things, of which one moves, leave body i no room.
  [[noreturn]] void fail_squeezed(Entity i, vector<Entity> things) const;
  /// The latest end of body i's flight: the end of a step of its own or of its island.
  [[gnu::always_inline]] Instant flight_end(Entity i) const {
    Instant end{never, 0};
    if (is_member(mode(i))) end = islands.of(i).end;
    if (const PolynomialPath* curve = flights.curve(i)) end = min(end, flights[i].start + curve->length);
    return end;
  }
  /// Whether body i cannot strike a fixed thing, because it lies behind a flat surface of normal n, towards the body,
  /// that carries the body. A thing that comes out of the surface is not hidden.
  bool hidden(Entity i, const Vec3& x, Entity fixed, const Vec3& n, Entity surface) const {
    if (moving.any() && moving.comes_out(fixed, surface, n, now)) return false;
    return lies_behind(world, i, x, fixed, fixed_position(fixed), n);
  }

  /// Present positions and velocities of two bodies.
  struct PairState {
    Vec3 xa;  // m
    Vec3 va;  // m/s
    Vec3 xb;  // m
    Vec3 vb;  // m/s
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
  vector<Entity> neighbours_of(Entity i) const;
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
  bool any_taut(span<const Entity> those) const;
  /// The contact of a and b at xa, xb (m), which have just met at this feature.
  Touch touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, uint8_t feature) const;

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
  [[gnu::always_inline]] double smaller_length(Entity i, Entity e) const {
    const Entity second = world.second_body(e);
    return second != no_entity ? 2 * min(world.radius[i], world.radius[second]) : world.radius[i];
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
};

}  // namespace carom
