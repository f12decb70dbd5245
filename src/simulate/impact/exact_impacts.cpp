// The effect of impacts of two on velocities: an impulse along the normal, by the pair's restitution
// (physics/impact.h). Where an impact ends in lasting contact, the bodies join an island instead of bouncing for ever.
#include "simulate/impact/exact_impacts.h"

#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/body_merging.h"
#include "simulate/impact/stall_guard.h"
#include "std.h"

namespace carom {

/// Resolves a strike that is too slow to wake the struck body, by a body that nothing presses on it. The struck body is
/// held, as if it were fixed.
void ExactImpacts::bounce_off(const PairImpact& impact, Entity striker, Entity struck) {
  const Touch& there = impact.there;
  const double mass = bodies_.world.mass[striker];
  const double approach = impact.approach;
  const double separation = impact.e * approach;
  const double impulse = impact_impulse(mass, ExactBodies::immovable, approach, separation);
  const double lost = impact_loss(mass, ExactBodies::immovable, approach, separation);
  bodies_.contact_work.impulses.strike(bodies_.now, impact.a, impact.b, impulse);
  rules_.book({bodies_.now.hi, CollisionKind::body_body, impact.a, impact.b, there.point, there.normal, approach,
               separation, impact.e, impulse, lost},
              false, impact.press, impact.length);

  // The normal points from the lower number to the higher one.
  const Vec3 away = striker < struck ? Vec3(-there.normal) : there.normal;
  const Vec3 after = bodies_.velocity(striker) + (approach + separation) * away;
  parts_.flights.begin(striker, bodies_.position(striker), parts_.flat.keep_at(striker, after),
                       {struck, impact.feature});
}

void ExactImpacts::collide_pair(Entity a, Entity b, uint8_t feature) {
  const PairImpact impact = rules_.find_pair(a, b, feature);
  bodies_.log.note_overlap(-impact.there.gap);
  bodies_.note_speed(a, impact.va);
  bodies_.note_speed(b, impact.vb);
  if (otherwise_) [[unlikely]]
    return bodies_.options.merge ? parts_.merging.merge(a, b, impact.there) : resolve<true>(impact);
  resolve<false>(impact);
}

/// `summed`: its impulse counts for a sum.
template <bool summed>
inline void ExactImpacts::resolve(const PairImpact& impact) {
  const Entity a = impact.a;
  const Entity b = impact.b;
  parts_.guard.note_restitution(impact.e);
  if (const Entity struck = rules_.left_asleep(impact); struck != no_entity) [[unlikely]]
    return bounce_off(impact, struck == b ? a : b, struck);

  // The impulse, by which the two separate at e times their approach, or not at all.
  const bool ends = rules_.ends(impact, false);
  const double separation = ends ? 0 : impact.e * impact.approach;
  const Collision met = with_effect(bodies_.world, {bodies_.now.hi, CollisionKind::body_body, a, b, impact.there.point,
                                                    impact.there.normal, impact.approach, separation, impact.e});
  rules_.book(met, ends, impact.press, impact.length);
  if constexpr (summed) bodies_.contact_work.impulses.strike(bodies_.now, a, b, met.impulse);
  apply_pair(impact, met.impulse, ends);
}

/// Begins the flights of two bodies after their impact. Where it ends in contact, they join one island.
inline void ExactImpacts::apply_pair(const PairImpact& impact, double impulse, bool ends) {
  const Entity a = impact.a;
  const Entity b = impact.b;
  const Vec3& n = impact.there.normal;
  for (const Entity i : {a, b}) {
    if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
    parts_.group.note_needed(i);
  }
  if (ends) parts_.group.unite_fresh(a, b);

  const Vec3 after_a = impact.va - (impulse / bodies_.world.mass[a]) * n;
  const Vec3 after_b = impact.vb + (impulse / bodies_.world.mass[b]) * n;
  parts_.flights.begin(a, impact.xa, parts_.flat.keep_at(a, after_a), {b, impact.feature});
  parts_.flights.begin(b, impact.xb, parts_.flat.keep_at(b, after_b), {a, impact.feature});

  if (!ends) return;
  parts_.group.note_parted(a, b, false);
  for (const Entity i : {a, b}) parts_.group.await_step(i);
  parts_.group.unite(a, b);
}

/// Books the impulse by which a fixed thing changes a body's velocity (m/s) along the normal: the work of one that
/// moves.
void ExactImpacts::book_push(const FixedImpact& impact, double change) const {
  const double impulse = bodies_.world.mass[impact.body] * change;
  if (bodies_.moving.any()) bodies_.log.add_work(-impulse * impact.there.normal.dot(impact.u));
  bodies_.contact_work.impulses.strike(bodies_.now, impact.body, impact.surface, impulse);
}

void ExactImpacts::collide_fixed(Entity i, Entity surface, uint8_t feature) {
  const World& world = bodies_.world;
  const FixedImpact impact = rules_.find_fixed(i, surface, feature);
  if (bodies_.moving.any()) rules_.check_room(impact);
  const Vec3& x = impact.x;
  const Vec3& v = impact.v;
  const Vec3& n = impact.there.normal;
  const double approach = impact.approach;

  parts_.guard.note_restitution(impact.e, world.moves(surface));
  bodies_.log.note_overlap(-impact.there.gap);
  bodies_.note_speed(i, v);

  // It comes to rest on a flat surface, ends in lasting contact, or bounces.
  FlatContact contact;
  const bool rests = rules_.comes_to_rest(impact, contact);
  const bool taken_over = rests && !contact.settling;
  const bool ends = !rests && rules_.ends(impact, false);
  const bool leaves_nothing = ends || taken_over;
  const double separation = leaves_nothing ? 0 : impact.e * approach;
  if (ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
  parts_.group.note_needed(i);

  if (approach > 0 || separation > 0) {
    if (bodies_.contact_work.any()) [[unlikely]]
      book_push(impact, rests ? approach : approach + separation);
    const Collision met = with_effect(world, {bodies_.now.hi, CollisionKind::body_fixed, i, surface, impact.there.point,
                                              n, approach, separation, impact.e});
    // What a level surface takes over is not plastic.
    rules_.book(met, leaves_nothing, taken_over ? 0 : impact.press, world.radius[i]);
  }

  // The next flight begins: on the flat surface, or after the impulse.
  if (taken_over) parts_.flat.remove_level(i, contact.normal);
  if (rests) {
    parts_.flat.add(i, contact);
    parts_.flights.begin(i, x + impact.there.gap * n, parts_.flat.keep_at(i, v - approach * n), {surface, feature});
  } else {
    parts_.flights.begin(i, x, parts_.flat.keep_at(i, v - (approach + separation) * n), {surface, feature});
  }

  // In lasting contact its island's step is due.
  if (!ends) return;
  parts_.group.note_parted(i, surface, false);
  parts_.group.await_step(i);
}

}  // namespace carom
