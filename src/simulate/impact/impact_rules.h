#pragma once
// What decides how an impact ends: with its restitution, in lasting contact, or at rest on a flat surface.
#include "geometry/touch.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

struct Collision;
struct FlatContact;

class FlatContacts;

/// Two bodies at the instant of their impact.
struct PairImpact {
  Entity a;  // the lower number
  Entity b;
  uint8_t feature;
  Vec3 xa;          // m
  Vec3 xb;          // m
  Vec3 va;          // m/s
  Vec3 vb;          // m/s
  Vec3 w;           // m/s, of b relative to a
  Touch there;      // the normal points from a to b
  double e;         // restitution
  double approach;  // m/s
  double press;     // m/s^2, drives the two together
  double length;    // m, on which the two are slow
};

/// A body and a fixed thing at the instant of their impact.
struct FixedImpact {
  Entity body;
  Entity surface;
  uint8_t feature;
  bool flat;
  bool began_now;   // the flight began at this instant
  Vec3 x;           // m
  Vec3 v;           // m/s
  Vec3 u;           // m/s, of the fixed thing
  Touch there;      // the normal points into the thing
  double e;         // restitution
  double approach;  // m/s
  double press;     // m/s^2, drives the two together
};

/// A string that goes taut.
struct StringImpact {
  Entity string;
  Entity a;         // its body
  Entity b;         // that at its other end, or no_entity
  Touch there;      // the normal points from the other end to the body; an approach is a motion along it
  double e;         // restitution
  double approach;  // m/s
  double press;     // m/s^2, pulls the ends apart
  double length;    // m
};

class ImpactRules {
 public:
  ImpactRules(ExactBodies& bodies, CollapseDetector& collapses, ExactGroup& group, FlatContacts& flat)
      : bodies_(bodies), collapses_(collapses), group_(group), flat_(flat) {}

  /// Bodies a < b, which meet at this feature at the present instant.
  [[gnu::always_inline]] PairImpact find_pair(Entity a, Entity b, uint8_t feature) const;
  FixedImpact find_fixed(Entity i, Entity surface, uint8_t feature) const;
  StringImpact find_string(Entity string) const;

  /// Whether an impact ends in contact, so that nothing is left of the approach. It counts towards a collapse, unless
  /// the two have met at this instant before (`again`).
  [[gnu::always_inline]] bool ends(const PairImpact& impact, bool again);
  bool ends(const FixedImpact& impact, bool again);
  bool ends(const StringImpact& impact, bool again);
  /// Whether a flat surface carries the body from this instant on. If so, `contact` has the instant at which its
  /// bounces are over.
  bool comes_to_rest(const FixedImpact& impact, FlatContact& contact) const;
  /// The acceleration (m/s^2) with which two things in lasting contact were pressed together last.
  double pressed(Entity i, Entity e) const;
  /// The one of two bodies that sleeps, and that the impact is too slow to wake; no_entity: none.
  Entity left_asleep(const PairImpact& impact) const;
  /// Books the energy of an impact, and records it. `ends`: in contact. Then it is only counted, unless it is fast and
  /// its restitution zero. `press` (m/s^2) drives the two together, and they are slow on `length` (m).
  void book(const Collision& met, bool ends, double press, double length) const;
  /// Throws SimulationError where the thing that a body strikes and a surface opposite to it certainly leave the body
  /// no room, unless something else happens to it. Elastic impacts between the two would never end.
  void check_room(const FixedImpact& impact) const;

 private:
  [[gnu::noinline]] bool too_slow_to_wake(const PairImpact& impact, Entity striker, Entity struck) const;
  [[gnu::noinline]] double press_of(const PairImpact& impact) const;
  Vec3 pull_after(const PairImpact& impact, Entity i) const;
  [[gnu::noinline]] double holding(double press, Entity i, Entity e) const;
  [[gnu::noinline]] bool move_as_one(Entity a, Entity b, double approach) const;
  bool over_at_once(const FixedImpact& impact, double left) const;

  ExactBodies& bodies_;
  CollapseDetector& collapses_;
  ExactGroup& group_;
  FlatContacts& flat_;
};

// Pairs, the common case.
inline PairImpact ImpactRules::find_pair(Entity a, Entity b, uint8_t feature) const {
  const Flight& p = bodies_.flights[a];
  const Flight& q = bodies_.flights[b];
  const double ta = bodies_.now - p.start;
  const double tb = bodies_.now - q.start;
  PairImpact impact;
  impact.a = a;
  impact.b = b;
  impact.feature = feature;
  impact.xa = p.position(ta);
  impact.xb = q.position(tb);
  impact.va = p.velocity(ta);
  impact.vb = q.velocity(tb);

  // Far from the origin the relative path has more digits.
  impact.there = bodies_.touch_at(a, impact.xa, b, impact.xb, feature);
  impact.w = impact.vb - impact.va;
  if (bodies_.far_from_origin(a, impact.xa)) [[unlikely]] {
    const ExactBodies::PairState pair = bodies_.in_frame_of(a, b);
    impact.there = bodies_.touch_at(a, pair.xa, b, pair.xb, feature);
    impact.there.point += impact.xa;
    impact.w = pair.vb - pair.va;
  }

  const double closing = -impact.w.dot(impact.there.normal);
  impact.approach = closing > bodies_.negligible_speed() ? closing : 0;
  impact.e = pair_restitution(bodies_.world, a, b);
  impact.length = bodies_.smaller_length(a, b);
  impact.press = 0;
  if (p.a == q.a && p.fade == q.fade) [[likely]]
    return impact;
  const PairImpact copy = impact;
  impact.press = press_of(copy);
  return impact;
}

inline Entity ImpactRules::left_asleep(const PairImpact& impact) const {
  if (bodies_.mode(impact.b) == Mode::asleep && too_slow_to_wake(impact, impact.a, impact.b)) return impact.b;
  if (bodies_.mode(impact.a) == Mode::asleep && too_slow_to_wake(impact, impact.b, impact.a)) return impact.a;
  return no_entity;
}

inline bool ImpactRules::ends(const PairImpact& impact, bool again) {
  const Entity a = impact.a;
  const Entity b = impact.b;
  const double met = impact.approach;
  const double press = impact.press;
  const double speeds = impact.va.norm() + impact.vb.norm();

  // Where nothing presses, an approach that is only rounding ends with this impact.
  const double held = press > 0 || bodies_.islands.any() ? holding(press, a, b) : 0;
  const bool real = impact.approach > exact_tolerance::approach_rounding * speeds || held > 0;
  // The approach begins by a change of forces, out of a motion side by side.
  const auto side_by_side = [&] {
    return impact.w.dot(impact.there.normal) <= exact_tolerance::velocity_rounding * speeds;
  };
  const bool enters = met == 0 && side_by_side() && (bodies_.path_bends(a) || bodies_.path_bends(b));
  const auto fades = [&] { return bodies_.hops_fade(a, met, press) || bodies_.hops_fade(b, met, press); };

  return enters || (is_member(bodies_.mode(a)) && move_as_one(a, b, impact.approach)) ||
         (real && collapses_.count_impact(a, b, impact.e, met, held, impact.length, false, again)) ||
         (press > 0 &&
          (impact.e * met == 0 || bodies_.too_low(impact.xa, impact.e * met, press) || (impact.e == 1 && fades())));
}

}  // namespace carom
