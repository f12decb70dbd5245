// The effect of impacts of two on velocities: an impulse along the normal, by the pair's restitution
// (physics/impact.h). Where an impact ends in lasting contact, the bodies join an island instead of bouncing for ever.
// In time stepping, velocities contain a kick by later forces, and the difference to the approach without it is booked
// as the method's error.
#include "simulate/impact/exact_impacts.h"

#include <algorithm>

#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/body_merging.h"
#include "simulate/impact/simultaneous_impacts.h"
#include "simulate/impact/stall_guard.h"

namespace carom {

/// Resolves a strike that is too slow to wake the struck body, by a body that nothing presses on it. The struck body is
/// held, as if it were fixed.
void ExactImpacts::bounce_off(const PairImpact& impact, Entity striker, Entity struck) {
  const Touch& there = impact.there;
  const double mass = bodies_.world.mass[striker];
  const double e = impact.e;
  const double approach = impact.approach;
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
  parts_.flights.begin(striker, bodies_.position(striker), parts_.flat.keep_at(striker, after),
                       {struck, impact.feature});
}

void ExactImpacts::collide_pair(Entity a, Entity b, std::uint8_t feature) {
  const World& world = bodies_.world;
  const PairImpact impact = rules_.find_pair(a, b, feature);
  bodies_.log.note_overlap(-impact.there.gap);
  bodies_.note_speed(a, impact.va);
  bodies_.note_speed(b, impact.vb);
  if (bodies_.options.merge) return parts_.merging.merge(a, b, impact.there);

  parts_.guard.note_restitution(impact.e);
  if (const Entity struck = rules_.left_asleep(impact); struck != no_entity) [[unlikely]]
    return bounce_off(impact, struck == b ? a : b, struck);

  // The impulse, by which the two separate at e times their approach, or not at all.
  const double ma = world.mass[a];
  const double mb = world.mass[b];
  const Vec3& n = impact.there.normal;
  const double approach = impact.approach;
  const double met = impact.unkicked;
  const bool ends = rules_.ends(impact, false);
  const double separation = ends ? 0 : impact.e * met;
  const double impulse = impact_impulse(ma, mb, met, separation);

  // The energy is booked, and the impact is recorded or counted.
  const double lost = impact_loss(ma, mb, met, separation);
  bodies_.log.lose(lost);
  if (met != approach) bodies_.log.deviate(impact_loss(ma, mb, approach, met + separation - approach) - lost);

  const Collision collision = make_collision(world, CollisionKind::body_body, bodies_.now.hi, a, b, impact.there.point,
                                             n, met, separation, impact.e);
  if (!ends || rules_.is_plastic(collision, impact.press, impact.length))
    bodies_.log.record(collision);
  else if (met > 0)
    bodies_.log.take_up(met, collision.energy_lost);

  apply_pair(impact, impulse, ends);
}

/// Begins the flights of two bodies after their impact. Where it ends in contact, they join one island.
inline void ExactImpacts::apply_pair(const PairImpact& impact, double impulse, bool ends) {
  const Entity a = impact.a;
  const Entity b = impact.b;
  const Vec3& n = impact.there.normal;
  for (const Entity i : {a, b}) {
    if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
    parts_.group.widen_margin(i, impact.approach);
  }
  if (ends) parts_.group.unite_fresh(a, b);

  const Vec3 after_a = impact.va - (impulse / bodies_.world.mass[a]) * n;
  const Vec3 after_b = impact.vb + (impulse / bodies_.world.mass[b]) * n;
  parts_.flights.begin(a, impact.xa, parts_.flat.keep_at(a, after_a), {b, impact.feature});
  parts_.flights.begin(b, impact.xb, parts_.flat.keep_at(b, after_b), {a, impact.feature});

  // An impact may throw a member off its support, or end in contact.
  for (const Entity i : {a, b})
    if (parts_.group.opens(i)) release(i);
  if (!ends) return;
  parts_.group.note_parted(a, b, false);
  hold_together(a, b, n);
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

void ExactImpacts::collide_fixed(Entity i, Entity surface, std::uint8_t feature) {
  const World& world = bodies_.world;
  const FixedImpact impact = rules_.find_fixed(i, surface, feature);
  if (bodies_.moving.any()) rules_.check_room(impact);
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
  const bool rests = rules_.comes_to_rest(impact, contact);
  const bool taken_over = rests && !contact.settling;
  const bool ends = !rests && rules_.ends(impact, false);
  const bool leaves_nothing = ends || taken_over;
  const double separation = leaves_nothing ? 0 : impact.e * met;
  if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
  parts_.group.widen_margin(i, approach);

  // The energy is booked, and the impact is recorded or counted.
  if (approach > 0 || separation > 0) {
    const double impulse = mass * (rests ? approach : met + separation);
    if (bodies_.moving.any()) bodies_.log.add_work(-impulse * n.dot(impact.u));
    const auto loss = [&](double from, double to) { return impact_loss(mass, ExactBodies::immovable, from, to); };
    const double lost = loss(met, separation);
    bodies_.log.lose(lost);
    if (const double left = taken_over ? 0 : met + separation - approach; met != approach)
      bodies_.log.deviate(loss(approach, left) - lost);

    const Collision collision = make_collision(world, CollisionKind::body_fixed, bodies_.now.hi, i, surface,
                                               impact.there.point, n, met, separation, impact.e);
    if (!leaves_nothing || (ends && rules_.is_plastic(collision, impact.press, world.radius[i])))
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
    parts_.flights.begin(i, x, parts_.flat.keep_at(i, v - (met + separation) * n), {surface, feature});
  }

  if (parts_.group.opens(i)) release(i);

  // In lasting contact, what is left of the approach ends in the rest of the step.
  if (ends) {
    parts_.group.note_parted(i, surface, false);
    parts_.flights.hold(i);
    const double closing = n.dot(bodies_.velocity(i) - impact.u);
    if (closing > 0) parts_.flights.push(i, -closing * n);
    if (closing > 0 && bodies_.moving.any()) parts_.group.carry(i, closing, n.dot(impact.u));
  }
  if (ends) parts_.simultaneous.count_impact(i);
}

}  // namespace carom
