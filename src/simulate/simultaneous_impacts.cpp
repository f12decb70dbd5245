#include "simulate/simultaneous_impacts.h"

#include <algorithm>

#include "physics/contact_problem.h"
#include "simulate/tolerances.h"

namespace carom {

void SimultaneousImpacts::count_impact(Entity i) {
  if (!bodies_.is_stepped(i) || ++group_.impacts.write(i) <= exact_tolerance::few_impacts) return;
  Touching set = find_touching(i);
  const double open = exact_tolerance::open_margin * exact_tolerance::widest_margin * bodies_.world.radius[i];
  solve(set, group_.margin[i] > open);
  std::vector<Entity> changed = begin_flights(set);
  // These impacts have cost as much as a time step: the next one is due. This one was too long.
  Island& island = bodies_.islands.of(i);
  island.impact_pairs += set.pairs.size();
  if (island.impact_pairs > exact_tolerance::pairs_of_a_step * island.members.size() && bodies_.now < island.end) {
    island.step_length -= island.end - bodies_.now;
    island.end = bodies_.now;
    changed.push_back(i);
  }
  for (const Entity a : changed) predictor_.predict(a);
}

/// Member `first` and all that touch one another with it.
SimultaneousImpacts::Touching SimultaneousImpacts::find_touching(Entity first) const {
  const World& world = bodies_.world;
  const std::uint32_t unseen = ContactConstraint::fixed;
  const double closed = exact_tolerance::simultaneous_gap * group_.margin[first];  // m
  LazyArray<std::uint32_t>& index = group_.index;
  Touching set;
  set.members = {first};
  index.write(first) = 0;
  for (std::size_t k = 0; k < set.members.size(); ++k) {
    const Entity a = set.members[k];
    const Vec3 x = bodies_.position(a);
    for (const Entity e : bodies_.known_to(a)) {
      const bool body = world.is_body(e);
      if (body && !(bodies_.in_group(e) && bodies_.islands.same(e, first))) continue;
      const Vec3 xe = bodies_.position_of(e);
      const double far = world.radius[a] + (body ? world.radius[e] : never) + closed;
      if ((xe - x).squaredNorm() > 1.001 * far * far) continue;
      const Touch there = touch(world, a, x, e, xe);
      if (there.gap > closed) continue;
      if (body && index[e] == unseen) {
        index.write(e) = static_cast<std::uint32_t>(set.members.size());
        set.members.push_back(e);
      }
      if (!body || index[e] > k)
        set.pairs.push_back({static_cast<std::uint32_t>(k), body ? index[e] : unseen, there.normal});
    }
  }
  for (const Entity a : set.members) {
    index.write(a) = unseen;
    set.before.push_back(bodies_.velocity(a));
    set.inverse_mass.push_back(1 / world.mass[a]);
  }
  return set;
}

/// The velocities after the impacts. part: whether they part, as far as that makes no energy.
void SimultaneousImpacts::solve(Touching& set, bool part) const {
  double approach = 0;
  for (const ContactConstraint& p : set.pairs) {
    const Vec3 vb = p.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : set.before[p.b];
    approach = std::max(approach, p.normal.dot(set.before[p.a] - vb));
  }
  for (ContactConstraint& p : set.pairs) {
    p.target = part ? exact_tolerance::simultaneous_parting * approach : 0;
    p.slack = exact_tolerance::simultaneous_slack * approach;
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
    for (ContactConstraint& p : set.pairs) p.target = p.force = 0;
    certificate = press();
  }
  bodies_.log.note(certificate);
}

/// Gives those whose velocities have changed.
std::vector<Entity> SimultaneousImpacts::begin_flights(const Touching& set) {
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
