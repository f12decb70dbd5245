// The effect of impacts on velocities, one pair at a time: an impulse along the normal, by the pair's restitution
// (physics/impact.h). An impact ends in lasting contact if it is slow under load, or part of a collapse. The bodies
// then join an island instead of bouncing for ever. In time stepping, velocities contain a kick by later forces.
// Impacts use the approach without it, and the difference is booked as the method's error.
#include "simulate/impact/exact_impacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/body_merging.h"
#include "simulate/impact/simultaneous_impacts.h"
#include "simulate/impact/stall_guard.h"
#include "simulate/impact/string_impacts.h"
#include "simulate/tolerances.h"

namespace carom {

ExactImpacts::ExactImpacts(ExactBodies& bodies, const ImpactParts& parts)
    : bodies_(bodies), parts_(parts), strings_(std::make_unique<StringImpacts>(bodies, parts)) {}

ExactImpacts::~ExactImpacts() = default;

void ExactImpacts::tighten(Entity string) {
  strings_->tighten(string);
}

/// Whether the striker lies on flat surfaces and strikes a sleeping body that forces hold on all sides, at an approach
/// too slow (m/s) to lift it noticeably.
bool ExactImpacts::too_slow_to_wake(Entity striker, Entity struck, double approach) const {
  const World& world = bodies_.world;
  if (parts_.flat.of(striker).count == 0 || !bodies_.ties.of(struck).empty()) return false;
  const double lifts = 2 * exact_tolerance::waking_lift * bodies_.applied[struck].norm() * world.radius[struck];
  if (!(approach * approach < lifts)) return false;

  // At least three forces that are not in one plane.
  std::vector<Vec3> normals;
  const Vec3 x = bodies_.flights[struck].x;
  const auto hold = [&](Entity e) { normals.push_back(touch(world, struck, x, e, bodies_.position_of(e)).normal); };

  // The list of the lower body of a pair has the force.
  for (const PressingContact& p : parts_.group.pressing[struck])
    if (p.force > 0) hold(p.partner);
  for (const Entity e : bodies_.neighbours_of(struck))
    if (world.is_body(e) && bodies_.mode(e) == Mode::asleep)
      for (const PressingContact& p : parts_.group.pressing[e])
        if (p.partner == struck && p.force > 0) hold(e);

  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (std::abs(normals[i].cross(normals[j]).dot(normals[k])) > exact_tolerance::least_volume) return true;
  return false;
}

/// Resolves a strike that is too slow to wake the struck body, by a body that nothing presses on it. The struck body is
/// held, as if it were fixed.
void ExactImpacts::bounce_off(Entity striker, Entity struck, std::uint8_t feature, const Touch& there,
                              double approach) {
  const double mass = bodies_.world.mass[striker];
  const double e = pair_restitution(bodies_.world, striker, struck);
  const double separation = e * approach;

  Collision met = make_collision(bodies_.world, CollisionKind::body_body, bodies_.now.hi, std::min(striker, struck),
                                 std::max(striker, struck), there.point, there.normal, approach, separation, e);
  met.impulse = impact_impulse(mass, ExactBodies::immovable, approach, separation);
  met.energy_lost = impact_loss(mass, ExactBodies::immovable, approach, separation);
  bodies_.log.record(met);
  bodies_.log.lose(met.energy_lost);

  // The normal points from the lower number to the higher one.
  const Vec3 away = striker < struck ? Vec3(-there.normal) : there.normal;
  const Vec3 after = bodies_.velocity(striker) + (approach + separation) * away;
  parts_.flights.begin(striker, bodies_.position(striker), parts_.flat.keep_at(striker, after), {struck, feature});
}

/// The acceleration (m/s^2) that drives together two bodies that have met here at the relative velocity w (m/s), after
/// their approach has ended.
double ExactImpacts::press_of(Entity a, const Vec3& xa, Entity b, const Vec3& xb, const Touch& there,
                              const Vec3& w) const {
  const Flight p = bodies_.flights[a];
  const Flight q = bodies_.flights[b];
  const Vec3& n = there.normal;

  double forces = n.dot(q.a - p.a);
  if (p.curve != nullptr || q.curve != nullptr) {
    forces = n.dot(pull_after(b, xb, q, a, there, w) - pull_after(a, xa, p, b, there, w));
    // Drag acts on the velocities after the impact.
  } else if (p.fade != 0 || q.fade != 0) {
    const double ma = bodies_.world.mass[a];
    const double mb = bodies_.world.mass[b];
    const double share = -n.dot(w) / (ma + mb);
    forces = n.dot(q.acceleration(bodies_.now - q.start) - p.acceleration(bodies_.now - p.start)) -
             (q.fade * ma + p.fade * mb) * share;
  }

  return -(forces + bending(bodies_.world, a, xa, b, xb, there, w));
}

/// The acceleration of body i at x (m), in m/s^2, after an impact has ended the approach.
/// The impact is at w, the velocity of the second body relative to the first (m/s).
Vec3 ExactImpacts::pull_after(Entity i, const Vec3& x, const Flight& f, Entity other, const Touch& there,
                              const Vec3& w) const {
  const double mi = bodies_.world.mass[i];
  const double mo = bodies_.world.mass[other];
  const double share = mo / (mi + mo);
  const Vec3 towards = there.normal.dot(w) * there.normal;  // m/s
  const Vec3 v = f.velocity(bodies_.now - f.start) + (i < other ? share : -share) * towards;
  return bodies_.flies_on_curve(i) ? bodies_.force_at(i, x, v) : f.acceleration(bodies_.now - f.start);
}

/// The acceleration that drives the two together (m/s^2), for which impacts are slow. Loads that cancel but for
/// rounding do not press. In time steps flights hold forces in advance, and any load may press.
double ExactImpacts::holding(double press, Entity i, Entity e) const {
  double loads = 0;
  bool stepped = false;
  for (const Entity k : {i, e}) {
    if (!bodies_.world.is_body(k)) continue;
    loads = std::max(loads, bodies_.applied[k].norm());
    stepped = stepped || may_be_kicked(bodies_.mode(k));
  }
  if (stepped) return std::max(press, loads);
  return press > exact_tolerance::curve_rounding * loads ? press : 0;
}

/// Whether the approach of two bodies (m/s) is an error of their paths: those of islands, which follow constraints to
/// rounding.
bool ExactImpacts::move_as_one(Entity a, Entity b, double approach) const {
  return bodies_.mode(a) == Mode::held && bodies_.mode(b) == Mode::held &&
         approach <= bodies_.drift_of(a, bodies_.velocity(a), bodies_.velocity(b));
}

/// Bodies a < b at the instant of their impact, and its effect.
struct ExactImpacts::PairImpact {
  Entity a;
  Entity b;
  std::uint8_t feature;
  bool ends;                            // in lasting contact
  double approach;                      // m/s
  double impulse;                       // N s
  const Vec3& n;                        // unit, from a to b
  const Vec3& xa;                       // m
  const Vec3& xb;                       // m
  const Vec3& va;                       // m/s, before the impact
  const Vec3& vb;                       // m/s, before the impact
  const StringImpacts::Passed* passed;  // null: no string passes it on
};

void ExactImpacts::collide_pair(Entity a, Entity b, std::uint8_t feature) {
  const World& world = bodies_.world;
  const Flight& p = bodies_.flights[a];
  const Flight& q = bodies_.flights[b];
  const double ta = bodies_.now - p.start;
  const double tb = bodies_.now - q.start;
  const Vec3 xa = p.position(ta);
  const Vec3 xb = q.position(tb);
  const Vec3 va = p.velocity(ta);
  const Vec3 vb = q.velocity(tb);

  // Far from the origin the relative path has more digits.
  Touch there = bodies_.touch_at(a, xa, b, xb, feature);
  Vec3 w = vb - va;
  if (bodies_.far_from_origin(a, xa)) [[unlikely]] {
    const ExactBodies::PairState pair = bodies_.in_frame_of(a, b);
    there = bodies_.touch_at(a, pair.xa, b, pair.xb, feature);
    there.point += xa;
    w = pair.vb - pair.va;
  }

  bodies_.log.note_overlap(-there.gap);
  bodies_.note_speed(a, va);
  bodies_.note_speed(b, vb);
  if (bodies_.options.merge) return parts_.merging.merge(a, b, there);

  const double ma = world.mass[a];
  const double mb = world.mass[b];
  const Vec3& n = there.normal;
  const double approach = -w.dot(n) > bodies_.negligible_speed() ? -w.dot(n) : 0;
  const double e = pair_restitution(world, a, b);
  parts_.guard.note_restitution(e);
  const double met = parts_.group.approach_without_kick(approach, n, a, b);

  const double length = bodies_.smaller_length(a, b);
  const double press = p.a == q.a && p.fade == q.fade ? 0 : press_of(a, xa, b, xb, there, w);
  if (press <= 0)
    for (const auto& [striker, struck] : {std::pair(a, b), std::pair(b, a)})
      if (bodies_.mode(struck) == Mode::asleep && too_slow_to_wake(striker, struck, approach))
        return bounce_off(striker, struck, feature, there, approach);

  // Where nothing presses, an approach that is only rounding ends with this impact.
  const double held = press > 0 || bodies_.islands.any() ? holding(press, a, b) : 0;
  const bool real = approach > exact_tolerance::approach_rounding * (va.norm() + vb.norm()) || held > 0;
  // The approach begins by a change of forces, out of a motion side by side.
  const auto side_by_side = [&] { return exact_tolerance::velocity_rounding * (va.norm() + vb.norm()); };
  const bool enters = met == 0 && w.dot(n) <= side_by_side() && (bodies_.path_bends(a) || bodies_.path_bends(b));
  const bool ends = (approach > 0 && met == 0) || enters ||
                    (is_member(bodies_.mode(a)) && move_as_one(a, b, approach)) ||
                    (real && parts_.collapses.count_impact(a, b, e, met, held, length, false)) ||
                    (press > 0 && (e * met == 0 || bodies_.too_low(xa, e * met, press) ||
                                   (e == 1 && (bodies_.hops_fade(a, met, press) || bodies_.hops_fade(b, met, press)))));
  const double separation = ends ? 0 : e * met;

  // Strings that hold the bodies take part.
  const StringImpacts::Passed* const passed =
      bodies_.ties.any() ? strings_->pass_on({a, b, n, approach, met + separation, 0}) : nullptr;
  const double impulse = passed ? passed->impulse : impact_impulse(ma, mb, met, separation);
  // J, by an impulse that changes the approach from one speed to the separation at another one.
  const auto loss = [&](double from, double to) {
    return passed ? 0.5 * impulse * (from - to) : impact_loss(ma, mb, from, to);
  };
  const double lost = loss(met, separation);
  bodies_.log.lose(lost);
  if (met != approach) bodies_.log.deviate(loss(approach, met + separation - approach) - lost);

  Collision collision =
      make_collision(world, CollisionKind::body_body, bodies_.now.hi, a, b, there.point, n, met, separation, e);
  if (passed) {
    collision.impulse = impulse;
    collision.energy_lost = lost;
  }
  if (!ends || is_plastic(collision, press, length))
    bodies_.log.record(collision);
  else if (met > 0)
    bodies_.log.take_up(met, collision.energy_lost);

  apply_pair({a, b, feature, ends, approach, impulse, n, xa, xb, va, vb, passed});
}

/// Begins the flights of two bodies after their impact. Where it ends in contact, they join one island.
void ExactImpacts::apply_pair(const PairImpact& impact) {
  const auto& [a, b, feature, ends, approach, impulse, n, xa, xb, va, vb, passed] = impact;
  const double ma = bodies_.world.mass[a];
  const double mb = bodies_.world.mass[b];
  for (const Entity i : {a, b}) {
    if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
    parts_.group.widen_margin(i, approach);
  }
  if (ends) parts_.group.unite_fresh(a, b);

  const Vec3 after_a = passed ? passed->v[0] : Vec3(va - (impulse / ma) * n);
  const Vec3 after_b = passed ? passed->v[1] : Vec3(vb + (impulse / mb) * n);
  parts_.flights.begin(a, xa, parts_.flat.keep_at(a, after_a), {b, feature});
  parts_.flights.begin(b, xb, parts_.flat.keep_at(b, after_b), {a, feature});
  if (passed) strings_->begin_beyond(*passed, a, b);

  // An impact may throw a member off its support, or end in contact.
  for (const Entity i : {a, b})
    if (parts_.group.opens(i)) release(i);
  if (ends) hold_together(a, b, n);
  if (!ends) return;
  parts_.simultaneous.count_impact(a);
  parts_.simultaneous.count_impact(b);
}

/// Unites members a and b, which have met along n. What is left of their approach ends in the rest of the step.
void ExactImpacts::hold_together(Entity a, Entity b, const Vec3& n) {
  for (const Entity i : {a, b}) parts_.flights.hold(i);
  const double closing = n.dot(bodies_.velocity(a) - bodies_.velocity(b));
  if (closing > 0) {
    const double ma = bodies_.world.mass[a];
    const double mb = bodies_.world.mass[b];
    const double held = impact_impulse(ma, mb, closing, 0);
    parts_.flights.push(a, -held / ma * n);
    parts_.flights.push(b, held / mb * n);
  }
  parts_.group.unite(a, b);
}

/// Lets member i fall, because an impact has thrown it off its support.
void ExactImpacts::release(Entity i) {
  parts_.flights.release(i);
  parts_.group.let_go(i);
}

/// Whether an impact ends in contact because its restitution is zero, at any speed.
bool ExactImpacts::is_plastic(const Collision& met, double press, double length) const {
  return met.restitution == 0 && press > 0 && met.approach_speed > bodies_.slow_speed(press, length);
}

ExactImpacts::FixedImpact ExactImpacts::find_fixed(Entity i, Entity surface, std::uint8_t feature) {
  const World& world = bodies_.world;
  const Flight f = bodies_.flights[i];
  const double t = bodies_.now - f.start;
  const Vec3 x = f.position(t);
  const Vec3 v = f.velocity(t);
  const Vec3 point = bodies_.fixed_position(surface);
  const Vec3 u = bodies_.fixed_velocity(surface);

  const bool flat = is_flat(world, i, surface, feature);
  const Touch there = bodies_.touch_at(i, x, surface, point, feature);
  const Vec3& n = there.normal;
  const double towards = (v - u).dot(n);
  const double approach = towards > bodies_.negligible_speed() ? towards : 0;

  bodies_.refresh(i, x, v - approach * n);
  const double bend = flat ? 0 : bending(world, i, x, surface, point, there, u - v);
  // In constrained motion other contacts are part of the flight. Drag then acts on the velocity after the impact.
  double pull;  // m/s^2
  if (bodies_.mode(i) == Mode::held) {
    pull = f.acceleration(t).dot(n) + bodies_.fade[i] * approach;
  } else {
    const FlatSolution without = parts_.flat.acceleration_without(i, surface);
    bodies_.log.note(without.certificate);
    pull = without.u.dot(n) + parts_.flat.drag_along(i, n, surface);
  }

  return {i,
          surface,
          feature,
          flat,
          f.start == bodies_.now,
          x,
          v,
          u,
          there,
          pair_restitution(world, i, surface),
          approach,
          parts_.group.approach_without_kick(approach, n, i, surface),
          pull - bend};
}

/// Whether a flat surface carries the body from this instant on. If so, `contact` has the instant at which its bounces
/// are over.
bool ExactImpacts::comes_to_rest(const FixedImpact& impact, FlatContact& contact) const {
  const auto& [i, surface, feature, flat, began_now, x, v, u, there, e, approach, unkicked, press] = impact;
  const double separation = e * unkicked;
  contact = {surface, feature, -there.normal, false, bodies_.now, separation};
  const std::size_t carrying = parts_.flat.of(i).count;

  // A surface nearly level with one that carries the body takes over. Hops that rounding hides do not count.
  const double weight = bodies_.applied[i].dot(there.normal);
  if (carrying > 0 && flat && carrying < FlatContactList::most && !in_lasting_contact(bodies_.mode(i)) && e <= 1 &&
      weight > 0 &&
      approach * approach <
          weight * exact_tolerance::position_rounding * (x.cwiseAbs().sum() + bodies_.world.radius[i])) {
    contact.residual_speed = 0;
    contact.rest_time = bodies_.now;
    return true;
  }

  // The body's path on the surface is not a parabola.
  if (bodies_.bent[i]) return false;
  const bool ends = e < 1 || approach == 0 ||
                    (e == 1 && (bodies_.too_low(x, approach, press) || bodies_.hops_fade(i, approach, press)));
  if (!(press > 0) || !flat || in_lasting_contact(bodies_.mode(i)) || carrying >= FlatContactList::most || !ends)
    return false;

  const double left = separation == 0 || e == 1 ? 0 : 2 * separation / (press * (1 - e));
  // The body does not hop on this surface alone. Other bodies, or the surfaces that carry it, throw it back at once.
  const bool carried = carrying > 0 && (bodies_.body[i].origin_partner != surface || began_now);
  contact.settling = over_at_once(impact, left) || (carried && bodies_.too_low(x, approach, press));
  contact.rest_time = bodies_.now + left;
  return contact.settling;
}

/// Whether bounces on a flat surface that end `left` (s) from the present are over.
bool ExactImpacts::over_at_once(const FixedImpact& impact, double left) const {
  return bodies_.now.hi + left == bodies_.now.hi || impact.approach < bodies_.options.rest_speed;
}

bool ExactImpacts::ends_in_contact(const FixedImpact& impact) {
  const auto& [i, surface, feature, flat, began_now, x, v, u, there, e, approach, unkicked, press] = impact;
  if (unkicked == 0 && (approach > 0 || bodies_.path_bends(i))) return true;
  const bool alone = flat && !parts_.collapses.among_bodies(i);
  const double held = holding(press, i, surface);
  if (parts_.collapses.count_impact(i, surface, e, unkicked, held, bodies_.world.radius[i], alone)) return true;
  const double separation = e * unkicked;
  if (!(press > 0)) return false;
  if (flat && bodies_.bent[i] && !in_lasting_contact(bodies_.mode(i)) && e < 1)
    return over_at_once(impact, 2 * separation / (press * (1 - e)));
  if (e == 1 && bodies_.hops_fade(i, separation, press)) return true;
  return (!flat || in_lasting_contact(bodies_.mode(i))) && (separation == 0 || bodies_.too_low(x, separation, press));
}

/// Throws SimulationError where the thing that body i strikes and a surface opposite to it certainly leave the body no
/// room, unless something else happens to it. Elastic impacts between the two would never end.
void ExactImpacts::check_room(const FixedImpact& impact) const {
  const World& world = bodies_.world;
  const Vec3& n = impact.there.normal;
  const double until = std::min(bodies_.moving.next_switch(bodies_.now.floor()), bodies_.options.duration);
  const Entity i = impact.body;

  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || e == impact.surface) continue;
    const Vec3 point = bodies_.fixed_position(e);
    const Vec3 u = bodies_.fixed_velocity(e);
    const Touch opposite = touch(world, i, impact.x, e, point);
    if ((opposite.normal + n).norm() > exact_tolerance::level || !is_flat(world, i, e, opposite.feature)) continue;

    const double closing = n.dot(u - impact.u);
    if (opposite.gap > exact_tolerance::least_gap * world.radius[i] || !(closing > 0)) continue;

    // The room ends before the run, a change of motion and the rim of the surface.
    const double left = opposite.gap / closing;
    if (bodies_.now.hi + left > until) continue;
    const RelativeMotion along{point - impact.x, u - impact.v, Vec3::Zero(), impact.v.norm(), true};
    if (leave_feature(world, i, e, opposite.feature, along, left).time < never) continue;
    bodies_.fail_squeezed(i, {impact.surface, e});
  }
}

void ExactImpacts::collide_fixed(Entity i, Entity surface, std::uint8_t feature) {
  const World& world = bodies_.world;
  const FixedImpact impact = find_fixed(i, surface, feature);
  if (bodies_.moving.any()) check_room(impact);
  const Vec3& x = impact.x;
  const Vec3& v = impact.v;
  const Vec3& n = impact.there.normal;
  const double approach = impact.approach;
  const double met = impact.unkicked;
  const double mass = world.mass[i];

  parts_.guard.note_restitution(impact.e, world.moves(surface));
  bodies_.log.note_overlap(-impact.there.gap);
  bodies_.note_speed(i, v);

  // It comes to rest on a flat surface, ends in lasting contact, or bounces.
  FlatContact contact;
  const bool rests = comes_to_rest(impact, contact);
  const bool taken_over = rests && !contact.settling;
  const bool ends = !rests && ends_in_contact(impact);
  const bool leaves_nothing = ends || taken_over;
  const double separation = leaves_nothing ? 0 : impact.e * met;
  if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
  parts_.group.widen_margin(i, approach);

  // Strings that hold the body take part.
  const StringImpacts::Passed* const passed =
      bodies_.ties.any() && !rests ? strings_->pass_on({i, surface, n, approach, met + separation, n.dot(impact.u)})
                                   : nullptr;

  // The energy is booked, and the impact is recorded or counted.
  if (approach > 0 || separation > 0) {
    const double impulse = passed ? passed->impulse : mass * (rests ? approach : met + separation);
    if (bodies_.moving.any()) bodies_.log.add_work(-impulse * n.dot(impact.u));
    const auto loss = [&](double from, double to) {
      return passed ? 0.5 * impulse * (from - to) : impact_loss(mass, ExactBodies::immovable, from, to);
    };
    const double lost = loss(met, separation);
    bodies_.log.lose(lost);
    if (const double left = taken_over ? 0 : met + separation - approach; met != approach)
      bodies_.log.deviate(loss(approach, left) - lost);

    Collision collision = make_collision(world, CollisionKind::body_fixed, bodies_.now.hi, i, surface,
                                         impact.there.point, n, met, separation, impact.e);
    if (passed) {
      collision.impulse = impulse;
      collision.energy_lost = lost;
    }
    if (!leaves_nothing || (ends && is_plastic(collision, impact.press, world.radius[i])))
      bodies_.log.record(collision);
    else if (met > 0)
      bodies_.log.take_up(met, collision.energy_lost);
  }

  // The next flight begins: on the flat surface, or after the impulse.
  if (taken_over) parts_.flat.remove_level(i, contact.normal);
  if (rests) {
    parts_.flat.add(i, contact);
    parts_.flights.begin(i, x + impact.there.gap * n, parts_.flat.keep_at(i, v - approach * n), {surface, feature});
  } else {
    const Vec3 after = passed ? passed->v[0] : Vec3(v - (met + separation) * n);
    parts_.flights.begin(i, x, parts_.flat.keep_at(i, after), {surface, feature});
    if (passed) strings_->begin_beyond(*passed, i, no_entity);
  }

  if (parts_.group.opens(i)) release(i);

  // In lasting contact, what is left of the approach ends in the rest of the step.
  if (ends) {
    parts_.flights.hold(i);
    const double closing = n.dot(bodies_.velocity(i) - impact.u);
    if (closing > 0) parts_.flights.push(i, -closing * n);
    if (closing > 0 && bodies_.moving.any()) parts_.group.carry(i, closing, n.dot(impact.u));
  }
  if (ends) parts_.simultaneous.count_impact(i);
}

}  // namespace carom
