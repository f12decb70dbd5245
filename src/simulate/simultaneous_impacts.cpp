#include "simulate/simultaneous_impacts.h"

#include <algorithm>

#include "physics/contact_problem.h"
#include "simulate/tolerances.h"

namespace carom {

namespace tol = exact_tolerance;

void SimultaneousImpacts::count_impact(Entity i) {
  if (!bodies_.is_stepped(i) || ++group_.impacts.write(i) <= tol::few_impacts) return;
  const Struck set = strike(i);
  std::vector<Entity> changed = begin_flights(set);
  // These impacts have cost as much as a time step: the next one is due. This one was too long.
  Island& island = bodies_.islands.of(i);
  island.impact_pairs += set.pairs.size();
  if (island.impact_pairs > tol::pairs_of_a_step * island.members.size() && bodies_.now < island.end) {
    island.step_length -= island.end - bodies_.now;
    island.end = bodies_.now;
    changed.push_back(i);
  }
  for (const Entity a : changed) predictor_.predict(a);
}

/// Member `first`, what touches it, and all that these would meet before the next step with the velocities that impacts
/// give them; and on from there as far as impacts reach.
SimultaneousImpacts::Struck SimultaneousImpacts::strike(Entity first) const {
  const Instant& end = bodies_.islands.of(first).end;
  Struck set;
  set.rest = bodies_.now < end ? end - bodies_.now : 0;
  take_in(set, first);
  for (std::size_t c = 0, count = set.near.pairs.size(); c < count; ++c)
    if (set.near.gaps[c] <= margin(set, c)) add(set, c);
  const double open = tol::open_margin * tol::widest_margin * bodies_.world.radius[first];
  do {
    solve(set, group_.margin[first] > open);
  } while (add_meeting(set));
  for (const Entity i : set.members) group_.index.write(i) = ContactConstraint::fixed;
  return set;
}

/// Member i and what is near it, unless it is there already.
void SimultaneousImpacts::take_in(Struck& set, Entity i) const {
  const World& world = bodies_.world;
  LazyArray<std::uint32_t>& index = group_.index;
  if (index[i] != ContactConstraint::fixed) return;
  const auto k = static_cast<std::uint32_t>(set.members.size());
  index.write(i) = k;
  set.members.push_back(i);
  set.inverse_mass.push_back(1 / world.mass[i]);
  set.before.push_back(bodies_.velocity(i));
  set.after.push_back(set.before.back());
  const Vec3 x = bodies_.position(i);
  const std::size_t first = set.near.pairs.size();
  for (const Entity e : bodies_.known_to(i)) {
    const bool body = world.is_body(e);
    // The one of the two that came first has the pair.
    if (body && (index[e] != ContactConstraint::fixed || !bodies_.in_group(e) || !bodies_.islands.same(e, i))) continue;
    const Touch there = touch(world, i, x, e, bodies_.position_of(e));
    set.near.add({k, ContactConstraint::fixed, there.normal}, {i, e, there.feature}, there.gap);
  }
  set.near.drop_hidden(world, x, first, group_.margin[i]);
  set.added.resize(set.near.pairs.size(), 0);
}

/// m, that time stepping keeps the two apart.
double SimultaneousImpacts::margin(const Struck& set, std::size_t near) const {
  const auto& [i, e, feature] = set.near.names[near];
  return std::max(group_.margin[i], bodies_.world.is_body(e) ? group_.margin[e] : 0);
}

/// m/s, with the velocities found so far.
double SimultaneousImpacts::approach(const Struck& set, std::size_t near) const {
  const Entity e = set.near.names[near].e;
  Vec3 v = Vec3::Zero();
  if (bodies_.world.is_body(e))
    v = group_.index[e] == ContactConstraint::fixed ? bodies_.velocity(e) : set.after[group_.index[e]];
  const ContactConstraint& p = set.near.pairs[near];
  return p.normal.dot(set.after[p.a] - v);
}

/// m/s: how fast two may approach that are to be no closer than their margin at the next step; infinite, where it is
/// due,
double SimultaneousImpacts::allowed(const Struck& set, std::size_t near) const {
  const double beyond = set.near.gaps[near] - margin(set, near);
  return beyond > 0 ? beyond / set.rest : 0;
}

/// and how much faster if they are to keep a share of their gap.
double SimultaneousImpacts::slack(const Struck& set, std::size_t near) const {
  const double room = tol::gap_share * std::min(set.near.gaps[near], margin(set, near));
  return room > 0 && set.rest > 0 ? room / set.rest : 0;
}

/// Adds what is near to the pairs.
void SimultaneousImpacts::add(Struck& set, std::size_t near) const {
  set.added[near] = 1;
  const Entity e = set.near.names[near].e;
  ContactConstraint pair = set.near.pairs[near];
  if (bodies_.world.is_body(e)) {
    take_in(set, e);
    pair.b = group_.index[e];
  }
  pair.target = -allowed(set, near);
  pair.slack = slack(set, near);
  set.pairs.push_back(pair);
}

/// Adds the pairs that would meet before the next step with these velocities. False: there are none.
bool SimultaneousImpacts::add_meeting(Struck& set) const {
  const std::size_t before = set.pairs.size(), count = set.near.pairs.size();
  for (std::size_t c = 0; c < count; ++c) {
    if (!set.added[c] && approach(set, c) > allowed(set, c) + std::max(slack(set, c), set.slack)) add(set, c);
  }
  return set.pairs.size() > before;
}

/// The velocities after the impacts. part: whether those that touch part, as far as that makes no energy.
void SimultaneousImpacts::solve(Struck& set, bool part) const {
  double fastest = 0;  // m/s
  for (const ContactConstraint& p : set.pairs) fastest = std::max(fastest, carom::approach(set.before, p));
  set.slack = tol::simultaneous_slack * fastest;
  for (ContactConstraint& p : set.pairs) {
    if (part && p.target >= 0) p.target = tol::simultaneous_parting * fastest;
    p.slack = std::max(p.slack, set.slack);
  }
  const auto press = [&] {
    set.after = set.before;
    return carom::solve({set.inverse_mass, set.after, set.pairs, ContactAccuracy::contacts});
  };
  Certificate certificate = press();
  double gained = 0;
  for (std::size_t k = 0; k < set.members.size(); ++k)
    gained += bodies_.world.mass[set.members[k]] * (set.after[k] - set.before[k]).dot(set.after[k] + set.before[k]);
  if (!certificate.solved() || gained > 0) {
    for (ContactConstraint& p : set.pairs) p.target = std::min(p.target, 0.0);
    certificate = press();
  }
  bodies_.log.note(certificate);
}

/// Gives those whose velocities have changed.
std::vector<Entity> SimultaneousImpacts::begin_flights(const Struck& set) {
  std::vector<Entity> changed;
  bodies_.log.take_up(set.inverse_mass, set.before, set.after, set.pairs);
  for (std::size_t k = 0; k < set.members.size(); ++k) {
    const Entity a = set.members[k];
    const Vec3 &before = set.before[k], &after = set.after[k];
    group_.impacts.write(a) = 1;
    if (after == before) continue;
    changed.push_back(a);
    bodies_.log.lose(0.5 * bodies_.world.mass[a] * (before - after).dot(before + after));
    flights_.begin(a, bodies_.position(a), after, {});
    bodies_.flights.accelerate(a, Vec3::Zero());
  }
  return changed;
}

}  // namespace carom
