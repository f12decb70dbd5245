// Impacts along strings. Where strings hold the struck bodies, the impulses in all of them come from one problem
// (contact_problem.h): the struck pair's row has the speed of its separation, a string's row zero. At that instant the
// strings have neither lengthened nor shortened. Their impulses do no work, and an impact with e = 1 loses no energy.
#include "simulate/impact/string_impacts.h"

#include <algorithm>
#include <cmath>

#include "physics/impact.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/contact_list.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/stall_guard.h"
#include "simulate/tolerances.h"

namespace carom {

const StringImpacts::Passed* StringImpacts::pass_on(const Strike& strike) {
  const auto held = [&](Entity i) {
    const std::span<const Entity> strings = bodies_.ties.of(i);
    return std::any_of(strings.begin(), strings.end(), [&](Entity string) { return bodies_.holds(string); });
  };
  const Entity b = bodies_.world.second_body(strike.thing);
  if (!held(strike.a) && !(b != no_entity && held(b))) return nullptr;
  solve_with_strings(strike);
  for (const Entity i : passed_.bodies)
    if (bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
  return &passed_;
}

/// The velocities after a strike, of its bodies and of all that strings connect with them.
void StringImpacts::solve_with_strings(const Strike& strike) {
  Numbering reached(parts_.group.numbers);
  Passed& passed = passed_;
  passed.v.clear();
  const auto take_in = [&](Entity i) {
    if (reached.add(i)) passed.v.push_back(bodies_.velocity(i));
  };
  const Entity b = bodies_.world.second_body(strike.thing);
  take_in(strike.a);
  if (b != no_entity) take_in(b);

  // The strings of these bodies, of those at their other ends, and so on.
  std::vector<Entity> strings;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Entity i = reached[k];
    for (const Entity string : bodies_.ties.of(i)) {
      if (!bodies_.holds(string)) continue;
      strings.push_back(string);
      if (const Entity other = bodies_.ties.other(string, i); other != no_entity) take_in(other);
    }
  }
  std::sort(strings.begin(), strings.end());
  strings.erase(std::unique(strings.begin(), strings.end()), strings.end());

  const auto row = [&](Entity i, Entity other, const Vec3& normal, double target) {
    return ContactConstraint{reached.number(i), reached.number(other), normal, target};
  };

  // The struck pair has the first row, and each string one of the others.
  ContactList rows;
  ContactConstraint struck = row(strike.a, b, strike.normal, strike.change - strike.approach);
  struck.surface = strike.surface;
  rows.add(struck, {strike.a, strike.thing, no_feature}, 0);
  for (const Entity string : strings) {
    const String& s = bodies_.world.string(string);
    ContactConstraint held = row(s.body, s.other, bodies_.string_now(string).normal, 0);
    held.bilateral = s.rod;
    held.slack = s.rod ? exact_tolerance::step_error * std::abs(strike.change) : 0;
    rows.add(held, {s.body, string, no_feature}, 0);
  }

  std::vector<double> inverse_mass;
  for (const Entity i : reached) inverse_mass.push_back(1 / bodies_.world.mass[i]);
  const Certificate certificate = solve({inverse_mass, passed.v, rows.pairs});
  if (certificate.verdict == Certificate::Verdict::infeasible) rows.check_room(bodies_, passed.v);
  bodies_.log.note(certificate);

  passed.bodies = reached.bodies();
  passed.impulse = rows.pairs.front().force;
}

void StringImpacts::begin_beyond(const Passed& passed, Entity a, Entity b) {
  for (std::size_t k = 0; k < passed.bodies.size(); ++k) {
    const Entity i = passed.bodies[k];
    if (i == a || i == b) continue;
    bodies_.note_speed(i, bodies_.velocity(i));
    parts_.flights.begin(i, bodies_.position(i), passed.v[k], {});
  }
}

void StringImpacts::tighten(Entity string) {
  const World& world = bodies_.world;
  const String& s = world.string(string);
  const Entity a = s.body;
  const Entity b = s.other;
  const bool anchored = b == no_entity;

  // The rest of a time step is not to come: a step with the string follows at once.
  for (const Entity i : {a, b}) {
    if (i == no_entity || !may_be_kicked(bodies_.mode(i))) continue;
    parts_.flights.begin(i, bodies_.position(i), bodies_.velocity(i), {});
    parts_.flights.release(i);
    parts_.group.let_go(i);
  }

  const Vec3 xa = bodies_.position(a);
  const Vec3 xb = bodies_.position_of(string);
  const Vec3 va = bodies_.velocity(a);
  const Vec3 vb = bodies_.velocity_of(string);
  const Touch there = touch(world, a, xa, string, xb);
  const Vec3& n = there.normal;
  const Vec3 w = vb - va;
  for (const Entity i : {a, b})
    if (i != no_entity) bodies_.note_speed(i, bodies_.velocity(i));

  const double rounding = exact_tolerance::velocity_rounding * (va.norm() + vb.norm());
  const double approach = -w.dot(n) > std::max(bodies_.negligible_speed(), rounding) ? -w.dot(n) : 0;
  const double e = s.restitution;
  parts_.guard.note_restitution(e);

  const Vec3 apart = bodies_.pull_of(string) - bodies_.pull_of(a);
  const double press = -(n.dot(apart) + bending(world, a, xa, string, xb, there, w));  // m/s^2
  const double length = bodies_.smaller_length(a, string);

  // Whether the string holds from here on, or its ends spring back.
  const auto fades = [&](Entity i) { return i != no_entity && bodies_.hops_fade(i, approach, press); };
  const auto collapses = [&](Entity i) {
    return i != no_entity && parts_.collapses.count_impact(i, string, e, approach, press, length, false);
  };
  const bool ends = e * approach == 0 || collapses(a) || collapses(b) ||
                    (press > 0 && (bodies_.too_low(xa, e * approach, press) || (e == 1 && (fades(a) || fades(b)))));
  const double separation = ends ? 0 : e * approach;

  solve_with_strings({a, string, n, approach, approach + separation, 0});
  const Passed& passed = passed_;
  const double lost = 0.5 * passed.impulse * (approach - separation);
  bodies_.log.lose(lost);

  // An impact that ends in contact is counted, unless it is fast and plastic.
  if (!ends || (e == 0 && approach > bodies_.slow_speed(std::max(press, 0.0), length))) {
    Collision met = make_collision(world, CollisionKind::string, bodies_.now.hi, a, string, there.point, n, approach,
                                   separation, e);
    met.impulse = passed.impulse;
    met.energy_lost = lost;
    bodies_.log.record(met);
  } else if (approach > 0) {
    bodies_.log.take_up(approach, lost);
  }

  // Sleeping bodies wake, and new flights begin.
  for (const Entity i : passed.bodies)
    if (bodies_.mode(i) == Mode::asleep || (ends && (i == a || i == b))) parts_.group.join(i);
  for (std::size_t k = 0; k < passed.bodies.size(); ++k)
    if (const Entity i = passed.bodies[k]; i == a || i == b)
      parts_.flights.begin(i, bodies_.position(i), parts_.flat.keep_at(i, passed.v[k]), {string, 0});
  begin_beyond(passed, a, b);

  // A string that holds connects the islands of its bodies. Their next step is due.
  if (ends && !anchored) parts_.group.unite(a, b);
  if (ends) bodies_.islands.of(a).end = bodies_.now;
}

}  // namespace carom
