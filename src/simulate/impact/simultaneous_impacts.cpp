// Resolves impacts within a time step for all bodies that are in contact at once, as one complementarity problem
// without restitution. Resolved one pair at a time, a body between others would be struck for ever. The set grows until
// no pair outside it is affected. Forces for the rest of the step are solved anew with the impacts. Otherwise a contact
// would press on a body that was struck off it, and make energy.
#include "simulate/impact/simultaneous_impacts.h"

#include <algorithm>

#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"

namespace carom {

namespace tol = exact_tolerance;

void SimultaneousImpacts::count_impact(Entity i) {
  if (!may_be_kicked(bodies_.mode(i)) || bodies_.any_taut(bodies_.islands.of(i).members) ||
      ++group_.member.write(i).impacts <= tol::few_impacts)
    return;
  const Struck set = strike(i);
  begin_flights(set);
  // These impacts have cost as much as a time step. The next one is due, because this one was too long.
  Island& island = bodies_.islands.of(i);
  island.impact_pairs += set.pairs.size();
  if (island.impact_pairs > tol::pairs_of_a_step * island.members.size() && bodies_.now < island.end) {
    island.step_length -= island.end - bodies_.now;
    island.end = bodies_.now;
    flights_.note_changed(i);
  }
}

/// The set of member `first` and the things that it touches. Bodies that these would meet before the next step join it,
/// as far as impacts reach.
SimultaneousImpacts::Struck SimultaneousImpacts::strike(Entity first) {
  const Instant& end = bodies_.islands.of(first).end;
  Struck set(Numbering(group_.numbers));
  set.rest = bodies_.now < end ? end - bodies_.now : 0;
  take_in(set, first);
  for (std::size_t c = 0, count = set.near.pairs.size(); c < count; ++c)
    if (set.near.gaps[c] <= margin(set, c)) add(set, c);
  // The next step separates them by itself.
  set.part =
      set.rest > 0 && group_.member[first].margin > tol::open_margin * tol::widest_margin * bodies_.world.radius[first];
  do {
    solve(set);
  } while (add_meeting(set));
  return set;
}

/// Adds member i and the things near it, unless they are in the set.
void SimultaneousImpacts::take_in(Struck& set, Entity i) const {
  const World& world = bodies_.world;
  if (!set.members.add(i)) return;
  const std::uint32_t k = set.members.number(i);
  set.inverse_mass.push_back(1 / world.mass[i]);
  set.before.push_back(bodies_.velocity_without_kick(i, bodies_.now));
  set.forced.push_back(forced(set, i));
  set.path.push_back(set.before.back() + set.forced.back());
  set.after.push_back(bodies_.velocity(i));
  const Vec3 x = bodies_.position(i);
  const std::size_t first = set.near.pairs.size();
  for (const Entity e : bodies_.neighbours_of(i)) {
    const bool body = world.is_body(e);
    // The pair belongs to the body that was added first.
    if (body &&
        (set.members.number(e) != Numbering::none || !is_member(bodies_.mode(e)) || !bodies_.islands.same(e, i)))
      continue;
    const Touch there = touch(world, i, x, e, bodies_.position_of(e));
    ContactConstraint pair{k, ContactConstraint::fixed, there.normal};
    if (!body) pair.surface = there.normal.dot(bodies_.fixed_velocity(e));
    set.near.add(pair, {i, e, there.feature}, there.gap);
  }
  set.near.drop_hidden(bodies_, x, first, group_.member[i].margin);
  set.added.resize(set.near.pairs.size(), 0);
  for (std::size_t c = first; c < set.near.pairs.size(); ++c) {
    const Entity e = set.near.names[c].e;
    // Otherwise the next step computes it anew.
    set.held.push_back(set.rest > 0 ? group_.pressing_force(i, e) * remaining(set, i, e) : 0);
  }
}

/// The time (s) for which member i's velocity contains forces, or will.
double SimultaneousImpacts::remaining(const Struck& set, Entity i) const {
  const Instant& until = bodies_.kick[i].until;
  return bodies_.now < until ? until - bodies_.now : set.rest;
}

/// The same for a pair. Its force ends with the first of the two.
double SimultaneousImpacts::remaining(const Struck& set, Entity i, Entity e) const {
  return std::min(remaining(set, i), bodies_.world.is_body(e) ? remaining(set, e) : never);
}

/// The change of member i's velocity by forces in that time (m/s), as far as it is determined.
Vec3 SimultaneousImpacts::forced(const Struck& set, Entity i) const {
  const double rest = remaining(set, i);
  return bodies_.now < bodies_.kick[i].until ? Vec3(rest * bodies_.kick[i].a) : flights_.by_forces(i, rest);
}

/// The distance that time stepping keeps between the two (m).
double SimultaneousImpacts::margin(const Struck& set, std::size_t near) const {
  const auto& [i, e, feature] = set.near.names[near];
  return std::max(group_.member[i].margin, bodies_.world.is_body(e) ? group_.member[e].margin : 0);
}

/// The speed of approach of a near pair (m/s), with these velocities of the set's members.
double SimultaneousImpacts::approach(const Struck& set, const std::vector<Vec3>& velocities, std::size_t near) const {
  const Entity e = set.near.names[near].e;
  Vec3 v = Vec3::Zero();
  if (bodies_.world.is_body(e))
    v = set.members.number(e) == ContactConstraint::fixed ? bodies_.velocity(e) : velocities[set.members.number(e)];
  const ContactConstraint& p = set.near.pairs[near];
  return p.normal.dot(velocities[p.a] - v) - p.surface;
}

/// The allowed speed of approach (m/s) for which the two are no closer than their margin at the next step. It is
/// infinite where that step is due.
double SimultaneousImpacts::allowed(const Struck& set, std::size_t near) const {
  const double beyond = set.near.gaps[near] - margin(set, near);
  return beyond > 0 ? beyond / set.rest : 0;
}

/// The additional speed of approach (m/s) that leaves them a share of their gap.
double SimultaneousImpacts::slack(const Struck& set, std::size_t near) const {
  const double room = tol::gap_share * std::min(set.near.gaps[near], margin(set, near));
  return room > 0 && set.rest > 0 ? room / set.rest : 0;
}

/// Adds a near thing to the pairs.
void SimultaneousImpacts::add(Struck& set, std::size_t near) const {
  set.added[near] = 1;
  const Entity e = set.near.names[near].e;
  ContactConstraint pair = set.near.pairs[near];
  if (bodies_.world.is_body(e)) {
    take_in(set, e);
    pair.b = set.members.number(e);
  }
  // The rows of a problem need one scale. These bodies cannot approach faster than at several times their speeds.
  double speeds = set.before[pair.a].norm() + set.forced[pair.a].norm();
  if (pair.b != ContactConstraint::fixed) speeds += set.before[pair.b].norm() + set.forced[pair.b].norm();
  pair.target = -std::min(allowed(set, near), 4 * speeds);
  pair.slack = slack(set, near);
  // The solution replaces it.
  pair.force = set.held[near];
  set.forced[pair.a] += pair.force * set.inverse_mass[pair.a] * pair.normal;
  if (pair.b != ContactConstraint::fixed) set.forced[pair.b] -= pair.force * set.inverse_mass[pair.b] * pair.normal;
  set.pairs.push_back(pair);
  pair.force = 0;
  set.impacts.push_back(pair);
  set.which.push_back(near);
}

/// Adds pairs that would meet before the next step with these velocities, and pairs that press and separate. False:
/// there are none.
bool SimultaneousImpacts::add_meeting(Struck& set) const {
  const std::size_t before = set.pairs.size(), count = set.near.pairs.size();
  for (std::size_t c = 0; c < count; ++c) {
    if (set.added[c]) continue;
    const double speed = approach(set, set.after, c), room = std::max(slack(set, c), set.slack);
    const bool meets = speed > allowed(set, c) + room;
    if (meets || (set.held[c] > 0 && speed < std::min(approach(set, set.path, c), 0.0) - room)) add(set, c);
  }
  return set.pairs.size() > before;
}

/// Computes the velocities after the impacts.
void SimultaneousImpacts::take_impacts(Struck& set) {
  set.struck = set.before;
  double fastest = 0;  // m/s
  for (const ContactConstraint& p : set.impacts) fastest = std::max(fastest, carom::approach(set.before, p));
  for (ContactConstraint& p : set.impacts) {
    p.target = std::min(p.target, 0.0);
    p.slack = std::max(p.slack, tol::simultaneous_slack * fastest);
  }
  bodies_.log.note(carom::solve({set.inverse_mass, set.struck, set.impacts, ContactAccuracy::energy}));
}

/// Computes the velocities after the impacts and the forces in the rest of the step.
void SimultaneousImpacts::solve(Struck& set) {
  take_impacts(set);
  std::vector<Vec3> free = set.struck;
  for (std::size_t k = 0; k < free.size(); ++k) free[k] += set.forced[k];
  double fastest = 0;  // m/s
  for (const ContactConstraint& p : set.pairs)
    fastest = std::max({fastest, carom::approach(set.before, p), carom::approach(set.path, p)});
  set.slack = tol::simultaneous_slack * fastest;
  for (ContactConstraint& p : set.pairs) {
    if (set.part && p.target >= 0) p.target = tol::simultaneous_parting * fastest;
    p.slack = std::max(p.slack, set.slack);
  }
  const auto press = [&] {
    set.after = free;
    return carom::solve({set.inverse_mass, set.after, set.pairs, ContactAccuracy::energy});
  };
  Certificate certificate = press();
  if (set.part && (!certificate.solved() || makes_energy(set))) {
    set.part = false;
    for (ContactConstraint& p : set.pairs) p.target = std::min(p.target, 0.0);
    certificate = press();
  }
  bodies_.log.note(certificate);
}

/// Whether the energy has grown by more than the work of forces.
bool SimultaneousImpacts::makes_energy(const Struck& set) {
  double made = 0;  // J
  for (std::size_t k = 0; k < set.members.size(); ++k) {
    const Vec3 &before = set.before[k], &after = set.after[k];
    made += (0.5 * (after - before).dot(after + before) - set.forced[k].dot(after)) / set.inverse_mass[k];
  }
  for (const ContactConstraint& p : set.pairs) made -= p.work();
  for (const ContactConstraint& p : set.impacts) made -= p.work();
  return made > 0;
}

/// Stores the forces that act from this instant on.
void SimultaneousImpacts::note_forces(const Struck& set) {
  for (std::size_t c = 0; c < set.pairs.size(); ++c) {
    const auto& [i, e, feature] = set.near.names[set.which[c]];
    const double force = set.pairs[c].force;
    if (!(force > 0 || set.held[set.which[c]] > 0)) continue;
    std::vector<PressingContact>& list = group_.pressing.write(std::min(i, e));
    const Entity partner = std::max(i, e);
    std::erase_if(list, [&](const PressingContact& p) { return p.partner == partner; });
    const double rest = remaining(set, i, e);
    if (force > 0 && rest > 0) list.push_back({partner, force / rest, set.pairs[c].surface});
  }
  if (!bodies_.moving.any()) return;
  for (const Entity i : set.members) group_.renew_power(i);
}

/// Begins the flights of the bodies with changed velocities.
void SimultaneousImpacts::begin_flights(const Struck& set) {
  bodies_.log.take_up(set.inverse_mass, set.before, set.struck, set.impacts);
  std::vector<std::uint8_t> pressed(set.members.size());
  for (std::size_t c = 0; c < set.pairs.size(); ++c) {
    const ContactConstraint& p = set.pairs[c];
    if (!(p.force > 0 || set.impacts[c].force > 0 || set.held[set.which[c]] > 0)) continue;
    pressed[p.a] = 1;
    if (p.b != ContactConstraint::fixed) pressed[p.b] = 1;
  }
  note_forces(set);
  for (std::size_t k = 0; k < set.members.size(); ++k) {
    const Entity a = set.members[k];
    group_.member.write(a).impacts = 1;
    if (!pressed[k]) continue;
    const Vec3 before = bodies_.velocity(a), &after = set.after[k];
    bodies_.log.deviate(0.5 * bodies_.world.mass[a] * (before - after).dot(before + after));
    if (!(bodies_.now < bodies_.kick[a].until)) bodies_.kick.write(a).until = bodies_.now + set.rest;
    const double rest = bodies_.kick[a].until - bodies_.now;
    bodies_.kick.write(a).a = rest > 0 ? Vec3((after - set.struck[k]) / rest) : Vec3(Vec3::Zero());
    flights_.begin(a, bodies_.position(a), after, {});
    bodies_.flights.accelerate(a, Vec3::Zero());
  }
}

}  // namespace carom
