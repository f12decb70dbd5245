// Perfectly inelastic collisions (chapter 8's two lumps of clay). The lighter body becomes part of the heavier one,
// which keeps its number and shape. Momentum, mass, volume and centre of mass are conserved. The energy lost includes
// that of the motion along the surfaces. The larger volume may overlap others. Fixed things push it out, and
// overlapping bodies merge too.
#include "simulate/impact/body_merging.h"

#include "physics/impact.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/contact/region_exit.h"
#include "simulate/path/path_log.h"
#include "std.h"

namespace carom {

void BodyMerging::merge(Entity a, Entity b, const Touch& there) {
  const World& world = bodies_.world;
  const Entity whole = world.mass[b] > world.mass[a] ? b : a;
  const Entity part = whole == a ? b : a;

  // The flights of both end here. The loss contains what their potential loses.
  for (const Entity i : {a, b}) paths_.note_change(i);
  for (const Entity i : {a, b}) end_flight(i);
  Collision met = meeting(a, b, there);
  met.energy_lost += join(whole, part);
  bodies_.log.lose(met.energy_lost);
  bodies_.log.record(met);
  bodies_.contact_work.impulses.strike(bodies_.now, a, b, met.impulse);

  // The larger volume has a new region, and is moved out of fixed things that it overlaps.
  renew_region(bodies_, whole, bodies_.body[whole].event.time.hi);
  move_out(whole);

  // The first body that it overlaps merges too. That merge looks for the next one.
  for (const Entity e : bodies_.neighbours_of(whole)) {
    if (!world.is_body(e)) continue;
    const Entity first = min(whole, e);
    const Entity second = max(whole, e);
    const Touch next = touch(world, first, bodies_.position(first), second, bodies_.position(second));
    if (next.gap < 0) return merge(first, second, next);
  }

  flights_.note_changed(whole);
  go_on(whole);
}

/// Lets the joint body fly on: with those that forces connect with it, or under forces that bend its path.
void BodyMerging::go_on(Entity whole) {
  if (const vector<Entity> all = group_.coupled_with(whole); !all.empty()) {
    group_.couple(all);
    for (const Entity i : all) flights_.note_changed(i);
  } else if (bodies_.flies_in_steps(whole)) {
    flights_.let_fall(whole);
  }
}

/// Books the flight of body i, which ends. A body in lasting contact leaves its island, which takes a step at once.
void BodyMerging::end_flight(Entity i) {
  const Vec3 x = bodies_.position(i);
  if (!in_lasting_contact(bodies_.mode(i))) return flights_.book(i, x, bodies_.now);

  if (is_member(bodies_.mode(i))) bodies_.contact_work.end_paths(bodies_.islands.of(i).members, bodies_.now);
  const Vec3 v = flights_.book_until(i, bodies_.now);
  for (const Entity k : group_.withdraw(i)) {
    bodies_.islands.of(k).end = bodies_.now;
    flights_.note_changed(k);
  }
  modes_.leave(i);
  flights_.take_out(i, x, v);
}

/// The record of bodies a and b, without what forces on them lose.
Collision BodyMerging::meeting(Entity a, Entity b, const Touch& there) const {
  const World& world = bodies_.world;
  const bool second = world.mass[b] > world.mass[a];
  const double mw = world.mass[second ? b : a];
  const double mp = world.mass[second ? a : b];
  const double mass = mw + mp;

  const Vec3 w = bodies_.velocity(b) - bodies_.velocity(a);
  const double approach = max(-w.dot(there.normal), 0.0);
  // The energy of the motion along the surfaces is lost too.
  const double impulse = approach * (mw * mp / mass);
  const double lost = 0.5 * (mw * mp / mass) * w.squaredNorm();
  return {bodies_.now.hi, CollisionKind::merge, a, b, there.point, there.normal, approach, 0, 0, impulse, lost};
}

/// The joint body continues from the centre of mass with the common momentum. Forces continue to act on the parts.
/// Returns what their potential loses (J).
double BodyMerging::join(Entity whole, Entity part) {
  const double mass_part = bodies_.world.mass[part];
  const double share = mass_part / (bodies_.world.mass[whole] + mass_part);
  const Vec3 xw = bodies_.position(whole);
  const Vec3 xp = bodies_.position(part);
  const Vec3 vw = bodies_.velocity(whole);
  const Vec3 vp = bodies_.velocity(part);
  const Vec3 x = xw + share * (xp - xw);
  const Vec3 v = vw + share * (vp - vw);

  double lost = potential({whole, part});  // J
  bodies_.merged.join(whole, part);
  bodies_.couplings.join(whole, part);

  // What acts on the whole is the mean, by mass, of what acts on the parts.
  if (!bodies_.world.forces.empty()) {
    const auto mean = [&]<typename T>(const LazyArray<T>& of) { return T(of[whole] + share * (of[part] - of[whole])); };
    bodies_.apply(whole, {mean(bodies_.applied), mean(bodies_.fade)});
    if (bodies_.varying) bodies_.apply_forces(whole, x, v);
  }

  // Both leave their flat surfaces, and contacts do no more work on them.
  for (const Entity i : {whole, part}) {
    flat_.clear(i);
    bodies_.contact_work.change(i, bodies_.now, 0);
  }

  // The part has no neighbours and no events any more. It rests at the centre of mass.
  modes_.merge(part);
  bodies_.neighbours.remove(part);
  flights_.count(part);
  flights_.note_changed(part);
  bodies_.flights.set(part, {bodies_.now, x, Vec3::Zero(), Vec3::Zero()});

  bodies_.flights.set(whole, {bodies_.now, x, v, bodies_.force_at(whole, x, v), bodies_.fade[whole]});
  lost = bodies_.forced ? lost - potential({whole}) : 0;
  flights_.count(whole);
  bodies_.body[whole].set_origin({});
  return lost;
}

/// The potential energy of these bodies, with each other and with all others (J).
double BodyMerging::potential(std::initializer_list<Entity> those) const {
  const auto position = [&](Entity i) { return bodies_.position(i); };
  double sum = bodies_.couplings.potential(span(those.begin(), those.size()), position);
  for (const Entity i : those) sum += bodies_.merged.potential(i, position(i));
  return sum;
}

/// Moves a joint body out of fixed things that its volume overlaps. The work of lifting it goes into the log.
void BodyMerging::move_out(Entity whole) {
  const World& world = bodies_.world;
  Flight f = bodies_.flights[whole];
  for (int pass = 0; pass < 8; ++pass) {
    bool free = true;
    for (const Entity e : bodies_.neighbours_of(whole)) {
      if (world.is_body(e)) continue;
      const Touch there = touch(world, whole, f.x, e, bodies_.fixed_position(e));
      if (!(there.gap < 0)) continue;

      const Vec3 out = there.gap * there.normal;
      const double before = potential({whole});
      f.x += out;
      bodies_.flights.set(whole, f);
      bodies_.log.add_work(potential({whole}) - before);
      free = false;
    }

    if (free) break;
  }
}

}  // namespace carom
