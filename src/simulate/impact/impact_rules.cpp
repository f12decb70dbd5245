// Decisions about impacts. An impact ends in lasting contact if it is slow under load, or part of a collapse. The
// bodies then join an island instead of bouncing for ever.
#include "simulate/impact/impact_rules.h"

#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

/// Where nothing presses, a striker that lies on flat surfaces and a sleeping body that forces hold on all sides, at an
/// approach too slow to lift it noticeably.
bool ImpactRules::too_slow_to_wake(const PairImpact& impact, Entity striker, Entity struck) const {
  const World& world = bodies_.world;
  if (impact.press > 0) return false;
  if (flat_.of(striker).count == 0 || !bodies_.ties.of(struck).empty() || bodies_.is_coupled(struck)) return false;
  const double lifts = 2 * exact_tolerance::waking_lift * bodies_.applied[struck].norm() * world.radius[struck];
  if (!(impact.approach * impact.approach < lifts)) return false;

  // At least three forces that are not in one plane.
  vector<Vec3> normals;
  const Vec3 x = bodies_.flights[struck].x;
  const auto add_normal = [&](Entity e) {
    normals.push_back(touch(world, struck, x, e, bodies_.position_of(e)).normal);
  };

  // The list of the lower body of a pair has the force.
  for (const PressingContact& p : group_.pressing[struck])
    if (p.force > 0) add_normal(p.partner);
  for (const Entity e : bodies_.neighbours_of(struck))
    if (world.is_body(e) && bodies_.mode(e) == Mode::asleep)
      for (const PressingContact& p : group_.pressing[e])
        if (p.partner == struck && p.force > 0) add_normal(e);

  for (size_t i = 0; i < normals.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      for (size_t k = 0; k < j; ++k)
        if (std::abs(normals[i].cross(normals[j]).dot(normals[k])) > exact_tolerance::least_volume) return true;
  return false;
}

/// The acceleration that drives together two bodies (m/s^2), after their approach has ended.
double ImpactRules::press_of(const PairImpact& impact) const {
  const Entity a = impact.a;
  const Entity b = impact.b;
  const Flight p = bodies_.flights[a];
  const Flight q = bodies_.flights[b];
  const Vec3& n = impact.there.normal;

  double forces = n.dot(q.a - p.a);
  if (p.curve != nullptr || q.curve != nullptr) {
    forces = n.dot(pull_after(impact, b) - pull_after(impact, a));
    // Drag acts on the velocities after the impact.
  } else if (p.fade != 0 || q.fade != 0) {
    const double ma = bodies_.world.mass[a];
    const double mb = bodies_.world.mass[b];
    const double share = -n.dot(impact.w) / (ma + mb);
    forces = n.dot(q.acceleration(bodies_.now - q.start) - p.acceleration(bodies_.now - p.start)) -
             (q.fade * ma + p.fade * mb) * share;
  }

  return -(forces + bending(bodies_.world, a, impact.xa, b, impact.xb, impact.there, impact.w));
}

/// The acceleration of body i, one of the two, after the impact has ended the approach (m/s^2).
Vec3 ImpactRules::pull_after(const PairImpact& impact, Entity i) const {
  const Entity other = i == impact.a ? impact.b : impact.a;
  const Flight f = bodies_.flights[i];
  const double mi = bodies_.world.mass[i];
  const double mo = bodies_.world.mass[other];
  const double share = mo / (mi + mo);
  const Vec3 towards = impact.there.normal.dot(impact.w) * impact.there.normal;  // m/s
  const Vec3 v = f.velocity(bodies_.now - f.start) + (i < other ? share : -share) * towards;
  if (!bodies_.flies_on_curve(i)) return f.acceleration(bodies_.now - f.start);
  return bodies_.force_at(i, i == impact.a ? impact.xa : impact.xb, v);
}

/// The acceleration that drives the two together (m/s^2), for which impacts are slow. Loads that cancel but for
/// rounding do not press. Between steps of a crowd any load may press.
double ImpactRules::holding(double press, Entity i, Entity e) const {
  double loads = 0;
  bool stepped = false;
  for (const Entity k : {i, e}) {
    if (!bodies_.world.is_body(k)) continue;
    loads = max(loads, bodies_.applied[k].norm());
    stepped = stepped || bodies_.mode(k) == Mode::stepped;
  }
  if (stepped) return max(press, loads);
  press = max(press, pressed(i, e));
  return press > exact_tolerance::curve_rounding * loads ? press : 0;
}

double ImpactRules::pressed(Entity i, Entity e) const {
  const Entity second = bodies_.world.second_body(e);
  if (!in_lasting_contact(bodies_.mode(i)) || (second != no_entity && !in_lasting_contact(bodies_.mode(second))))
    return 0;
  const double inverse = 1 / bodies_.world.mass[i] + (second == no_entity ? 0 : 1 / bodies_.world.mass[second]);
  return group_.pressing_force(i, e) * inverse;
}

/// Whether the approach of two bodies (m/s) is an error of their paths: those of islands, which follow constraints to
/// rounding.
bool ImpactRules::move_as_one(Entity a, Entity b, double approach) const {
  return bodies_.mode(a) == Mode::held && bodies_.mode(b) == Mode::held && bodies_.in_contact(a) &&
         bodies_.in_contact(b) && approach <= bodies_.drift_of(a, bodies_.velocity(a), bodies_.velocity(b));
}

void ImpactRules::book(const Collision& met, bool ends, double press, double length) const {
  const bool pressed = press > 0 || met.kind == CollisionKind::taut;
  const auto plastic = [&] {
    return met.restitution == 0 && pressed && met.approach_speed > bodies_.slow_speed(max(press, 0.0), length);
  };
  const bool recorded = !ends || plastic();
  if (!recorded && !(met.approach_speed > 0)) return bodies_.log.absorb(met.energy_lost);

  bodies_.log.lose(met.energy_lost);
  recorded ? bodies_.log.record(met) : bodies_.log.take_up(met.approach_speed, met.energy_lost);
}

FixedImpact ImpactRules::find_fixed(Entity i, Entity surface, uint8_t feature) const {
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
    const FlatSolution without = flat_.acceleration_without(i, surface);
    bodies_.log.note(without.certificate);
    pull = without.u.dot(n) + flat_.drag_along(i, n, surface);
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
          pull - bend - n.dot(bodies_.fixed_acceleration(surface, bodies_.now))};
}

bool ImpactRules::comes_to_rest(const FixedImpact& impact, FlatContact& contact) const {
  const auto& [i, surface, feature, flat, began_now, x, v, u, there, e, approach, press] = impact;
  const double separation = e * approach;
  contact = {surface, feature, -there.normal, false, bodies_.now, separation};
  const size_t carrying = flat_.of(i).count;

  // A surface nearly level with one that carries the body takes over. Hops that rounding hides do not count.
  const double weight = bodies_.applied[i].dot(there.normal);
  if (carrying > 0 && flat && carrying < FlatContactList::most && !in_lasting_contact(bodies_.mode(i)) && e <= 1 &&
      weight > 0 &&
      approach * approach <
          weight * exact_tolerance::position_rounding * (x.cwiseAbs().sum() + bodies_.world.radius[i]) &&
      bodies_.world.swing(surface) == nullptr) {
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
  if (bodies_.world.swing(surface) != nullptr) return false;

  const double left = separation == 0 || e == 1 ? 0 : 2 * separation / (press * (1 - e));
  // The body does not hop on this surface alone. Other bodies, or the surfaces that carry it, throw it back at once.
  const bool carried = carrying > 0 && (bodies_.body[i].origin_partner != surface || began_now);
  contact.settling = over_at_once(impact, left) || (carried && bodies_.too_low(x, approach, press));
  contact.rest_time = bodies_.now + left;
  return contact.settling;
}

/// Whether bounces on a flat surface that end `left` (s) from the present are over.
bool ImpactRules::over_at_once(const FixedImpact& impact, double left) const {
  return bodies_.now.hi + left == bodies_.now.hi || impact.approach < bodies_.options.rest_speed;
}

bool ImpactRules::ends(const FixedImpact& impact, bool again) {
  const auto& [i, surface, feature, flat, began_now, x, v, u, there, e, approach, press] = impact;
  if (approach == 0 && (bodies_.path_bends(i) || bodies_.world.swing(surface) != nullptr)) return true;
  const bool alone = flat && !collapses_.among_bodies(i);
  const double held = holding(press, i, surface);
  if (collapses_.count_impact(i, surface, e, approach, held, bodies_.world.radius[i], alone, again)) return true;
  const double separation = e * approach;
  if (!(press > 0)) return false;
  const bool curves = bodies_.bent[i] || bodies_.is_coupled(i) || bodies_.world.swing(surface) != nullptr;
  if (flat && curves && !bodies_.in_contact(i) && e < 1)
    return over_at_once(impact, 2 * separation / (press * (1 - e)));
  if (e == 1 && bodies_.hops_fade(i, separation, press)) return true;
  return (!flat || in_lasting_contact(bodies_.mode(i))) && (separation == 0 || bodies_.too_low(x, separation, press));
}

void ImpactRules::check_room(const FixedImpact& impact) const {
  const World& world = bodies_.world;
  const Vec3& n = impact.there.normal;
  const Entity i = impact.body;

  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || e == impact.surface) continue;
    const Vec3 point = bodies_.fixed_position(e);
    const Vec3 u = bodies_.fixed_velocity(e);
    const Touch opposite = touch(world, i, impact.x, e, point);
    if ((opposite.normal + n).norm() > exact_tolerance::level || !is_flat(world, i, e, opposite.feature)) continue;

    const double closing = n.dot(u - impact.u);
    if (opposite.gap > exact_tolerance::least_gap * world.radius[i] || !(closing > 0)) continue;

    // Faces that slow down in time leave room.
    const double slowing =
        -n.dot(bodies_.fixed_acceleration(e, bodies_.now) - bodies_.fixed_acceleration(impact.surface, bodies_.now));
    if (closing * closing < 2 * slowing * opposite.gap) continue;

    // The room ends before the run, a change of motion and the rim of the surface.
    const double left = opposite.gap / closing;
    const Instant until =
        min({bodies_.moving.next_switch(e, bodies_.now), bodies_.moving.next_switch(impact.surface, bodies_.now),
             Instant{bodies_.options.duration, 0}});
    if (until < bodies_.now + left) continue;
    const RelativeMotion along{point - impact.x, u - impact.v, Vec3::Zero(), impact.v.norm(), true};
    if (leave_feature(world, i, e, opposite.feature, along, left).time < never) continue;
    bodies_.fail_squeezed(i, {impact.surface, e});
  }
}

StringImpact ImpactRules::find_string(Entity string) const {
  const World& world = bodies_.world;
  const Entity a = world.string(string).body;
  const Vec3 xa = bodies_.position(a);
  const Vec3 xb = bodies_.position_of(string);
  const Vec3 va = bodies_.velocity(a);
  const Vec3 vb = bodies_.velocity_of(string);
  const Touch there = touch(world, a, xa, string, xb);
  const Vec3& n = there.normal;
  const Vec3 w = vb - va;

  const double rounding = exact_tolerance::velocity_rounding * (va.norm() + vb.norm());
  const double approach = -w.dot(n) > max(bodies_.negligible_speed(), rounding) ? -w.dot(n) : 0;
  const Vec3 apart = bodies_.pull_of(string) - bodies_.pull_of(a);
  const double press = -(n.dot(apart) + bending(world, a, xa, string, xb, there, w));
  return {string,   a,     world.string(string).other,       there, world.string(string).restitution,
          approach, press, bodies_.smaller_length(a, string)};
}

/// Whether the string holds from here on, or its ends spring back.
bool ImpactRules::ends(const StringImpact& impact, bool again) {
  const double press = impact.press;
  const double left = impact.e * impact.approach;  // m/s
  const auto fades = [&](Entity i) { return i != no_entity && bodies_.hops_fade(i, impact.approach, press); };
  const auto collapses = [&](Entity i) {
    return i != no_entity &&
           collapses_.count_impact(i, impact.string, impact.e, impact.approach, press, impact.length, false, again);
  };

  const bool too_low = bodies_.too_low(bodies_.position(impact.a), left, press);
  const bool faded = impact.e == 1 && (fades(impact.a) || fades(impact.b));
  return left == 0 || collapses(impact.a) || collapses(impact.b) || (press > 0 && (too_low || faded));
}

}  // namespace carom
