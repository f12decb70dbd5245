// Time stepping by one complementarity problem a step (Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673),
// without friction and with exact impacts. A step finds the pairs that may press, takes away slow approaches, and
// solves for velocities that keep all pairs apart until its end. It serves where contacts change too often to be
// followed one by one. The step adapts to speeds and forces, and an island in balance is put to rest.
#include "simulate/island/time_stepping.h"

#include <algorithm>
#include <cmath>

#include "physics/force.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Whether any of the pairs is below its target at these velocities.
bool approaching(const std::vector<Vec3>& v, const std::vector<ContactConstraint>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const ContactConstraint& p) { return -approach(v, p) < p.target - p.slack; });
}

}  // namespace

bool TimeStepping::advance(Entity i) {
  for (;;) {
    Step step = begin_step(i);
    if (solve_step(step)) {
      find_parts(step);
      put_to_rest(step);
      begin_flights(step);
      return true;
    }
    for (const Entity e : step.near) group_.unite(i, e);
    if (bodies_.any_taut(bodies_.islands.of(i).members)) return false;
  }
}

/// Solves the step, with the length that speeds allow. False: bodies of other islands are near.
bool TimeStepping::solve_step(Step& step) {
  const Island& island = bodies_.islands.of(step.members.front());
  const double shortest = shortest_step(step);
  step.shortest = shortest;
  step.short_steps = island.step_length < 0.01 * shortest ? island.short_steps + 1 : 0;
  double fastest = 0;
  for (const double speed : step.expected) fastest = std::max(fastest, speed);
  step.length = tol::step_displacement * step.smallest / std::max(fastest, 0x1p-900);
  if (step.greatest > 0) {
    const double longest = std::clamp(2 * island.step_length, shortest, tol::longest_step * shortest);
    step.length = std::clamp(step.length, shortest, longest);
  }
  do {
    find_pairs(step);
    if (!step.near.empty()) return false;
    take_slow_impacts(step);
    keep_apart(step);
  } while (shorten(step, shortest));
  return true;
}

/// The shortest step (s): a share of the time of falling by a radius, and of the time in which forces change.
double TimeStepping::shortest_step(const Step& step) const {
  if (step.greatest == 0) return 0;
  double rate = 0;  // 1/s
  for (std::size_t k = 0; k < step.members.size(); ++k)
    if (bodies_.bent[step.members[k]])
      rate = std::max(rate, force_rate(bodies_.world, step.members[k], step.x[k], step.v[k]));
  const double shortest = tol::shortest_step * std::sqrt(2 * step.smallest / step.greatest);
  return rate > 0 ? std::min(shortest, tol::shortest_step / rate) : shortest;
}

/// The positions and velocities of the members, without the part of the last step's kick for the time that is left of
/// it.
TimeStepping::Step TimeStepping::begin_step(Entity one) {
  const Islands& islands = bodies_.islands;
  std::vector<Entity> members = islands.of(one).members;
  std::sort(members.begin(), members.end());
  Step step(Numbering(group_.numbers, members));
  for (const Entity i : members) {
    Vec3 v = bodies_.velocity(i);
    if (bodies_.now < bodies_.kick[i].until) v -= bodies_.kick[i].rest(bodies_.now);
    step.x.push_back(bodies_.position(i));
    step.v.push_back(v);
    bodies_.refresh(i, step.x.back(), v);
    step.expected.push_back(v.norm());
    step.inverse_mass.push_back(1 / bodies_.world.mass[i]);
    step.smallest = std::min(step.smallest, bodies_.world.radius[i]);
    step.greatest = std::max(step.greatest, bodies_.force_at(i, step.x.back(), v).norm());
  }
  return step;
}

/// Whether the step must be solved again: shorter, or with a wider search for contacts.
bool TimeStepping::shorten(Step& step, double shortest) const {
  // m/s and m.
  double fastest = 0, displacements = 0;
  bool farther = false;
  for (std::size_t k = 0; k < step.x.size(); ++k) {
    const double speed = step.solved[k].norm();
    // A change of speed may move a body less far than its speed does, but impacts see it from the start.
    fastest = std::max({fastest, speed, 8 * (step.solved[k] - step.after_impacts[k]).norm()});
    displacements += step.length * speed;
    if (speed <= 2 * step.expected[k] || 4 * step.length * speed <= tol::pressing_gap * step.smallest) continue;
    step.expected[k] = speed;
    farther = true;
  }
  if (step.greatest > 0 && step.length > shortest &&
      fastest * step.length > 2 * tol::step_displacement * step.smallest) {
    step.length = std::max(0.5 * step.length, shortest);
    return true;
  }
  return farther && !(displacements > tol::converged_displacement * step.smallest * static_cast<double>(step.x.size()));
}

/// Finds the pairs that may press on each other before the step ends, and the speeds at which they must separate, or
/// may approach.
void TimeStepping::find_pairs(Step& step) {
  const World& world = bodies_.world;
  const double h = step.length;
  const auto margin_of = [&](std::size_t k) {
    return std::max({group_.member[step.members[k]].margin, tol::margin_of_displacement * h * step.v[k].norm(),
                     tol::least_margin * step.smallest});
  };
  const auto reach_of = [&](double expected) {  // m
    return std::min(4 * step.greatest * h * h, std::max(4 * h * expected, tol::pressing_gap * step.smallest));
  };
  for (std::size_t k = 0; k < step.members.size(); ++k) {
    const double reach = margin_of(k) + h * step.v[k].norm() + reach_of(step.expected[k]);
    bodies_.neighbours.hold(step.members[k], step.x[k], reach);
  }
  step.near.clear();
  step.contacts.clear();
  for (std::size_t k = 0; k < step.members.size(); ++k) {
    const Entity i = step.members[k];
    const std::size_t first = step.contacts.pairs.size();
    for (const Entity e : bodies_.neighbours_of(i)) {
      // A sleeping body acts as a fixed one. If pressed on, it wakes.
      const bool asleep = world.is_body(e) && bodies_.mode(e) == Mode::asleep;
      const bool body = world.is_body(e) && !asleep;
      if (body && !is_member(bodies_.mode(e))) continue;
      const std::uint32_t other = body ? step.members.number(e) : ContactConstraint::fixed;
      const bool of_other_island = body && other == ContactConstraint::fixed;
      if (body && !of_other_island && e < i) continue;
      const Touch there = touch(world, i, step.x[k], e, bodies_.position_of(e));
      const Vec3 ve = other != ContactConstraint::fixed ? step.v[other] : bodies_.velocity_of(e);
      const double rate = there.normal.dot(ve - step.v[k]);
      const double slow = step.greatest > 0 ? bodies_.slow_speed(step.greatest, bodies_.smaller_length(i, e)) : never;
      if (group_.strikes(i, e, -rate / tol::fast_impact, slow)) continue;
      const double margin_e = !body ? 0 : of_other_island ? group_.member[e].margin : margin_of(other);
      const double margin = std::max(margin_of(k), margin_e);
      const double expected = step.expected[k] + (!body ? 0 : of_other_island ? ve.norm() : step.expected[other]);
      if (there.gap + h * std::min(rate, 0.0) > margin + reach_of(expected)) continue;
      if (of_other_island) {
        step.near.push_back(e);
        continue;
      }
      ContactConstraint pair{static_cast<std::uint32_t>(k),
                             other,
                             there.normal,
                             -std::max(there.gap - margin, 0.0) / h,
                             std::max(tol::margin_slack * margin, tol::gap_share * std::min(there.gap, margin)) / h,
                             0};
      // With a wide margin, pairs that the slack would let strike at once separate by as much.
      if (step.greatest > 0 && margin > tol::parting_margin * step.smallest && there.gap < tol::margin_slack * margin &&
          pair_restitution(world, i, e) < 1)
        pair.target = (tol::margin_slack * margin - std::max(there.gap, 0.0)) / h;
      if (!body) pair.surface = there.normal.dot(ve);
      for (const PressingContact& p : group_.pressing[i])
        if (p.partner == e) pair.force = p.force * h;
      step.contacts.add(pair, {i, e, there.feature}, there.gap);
    }
    step.contacts.drop_hidden(bodies_, step.x[k], first);
  }
}

/// Computes the velocities after contact has taken away slow approaches.
void TimeStepping::take_slow_impacts(Step& step) {
  step.after_impacts = step.v;
  step.impacts.clear();
  if (step.greatest <= 0 || !approaching(step.v, step.contacts.pairs)) return;
  step.impacts = step.contacts.pairs;
  double fastest = 0;  // m/s
  for (const ContactConstraint& p : step.impacts) fastest = std::max(fastest, approach(step.v, p));
  for (ContactConstraint& p : step.impacts) {
    p.target = std::min(p.target, 0.0);
    p.slack = std::max(p.slack, tol::slow_slack * fastest);
    p.force = 0;
  }
  const Certificate certificate =
      carom::solve({step.inverse_mass, step.after_impacts, step.impacts, ContactAccuracy::energy});
  if (certificate.verdict == Certificate::Verdict::infeasible) step.contacts.check_room(bodies_, step.after_impacts);
  bodies_.log.note(certificate);
}

/// Computes the velocities that keep every pair apart until the step ends. Where margins are wide some pairs separate.
/// They do so if that is possible and takes no more energy than slow impacts have lost.
void TimeStepping::keep_apart(Step& step) {
  std::vector<Vec3> free = step.after_impacts;
  // 1/kg. Linear drag is implicit, as if bodies were heavier.
  std::vector<double> inverse_mass = step.inverse_mass;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Entity i = step.members[k];
    free[k] += step.length * bodies_.applied[i];
    if (bodies_.fade[i] == 0) continue;
    const double heavier = 1 + step.length * bodies_.fade[i];
    free[k] /= heavier;
    inverse_mass[k] /= heavier;
  }
  const auto press = [&] {
    step.solved = free;
    return carom::solve({inverse_mass, step.solved, step.contacts.pairs, ContactAccuracy::contacts});
  };
  bool part = std::any_of(step.contacts.pairs.begin(), step.contacts.pairs.end(),
                          [](const ContactConstraint& p) { return p.target > 0; });
  const auto press_only = [&] {
    for (ContactConstraint& p : step.contacts.pairs) p.target = std::min(p.target, 0.0);
    part = false;
  };
  const double lost = part ? lost_by_impacts(step) : 0;
  // This uses the last step's forces.
  if (part && parting_work(step) > lost) press_only();
  Certificate certificate = press();
  if (part && (!certificate.solved() || parting_work(step) > lost || makes_energy(step, free))) {
    press_only();
    certificate = press();
  }
  if (certificate.verdict == Certificate::Verdict::infeasible) step.contacts.check_room(bodies_, step.solved);
  bodies_.log.note(certificate);
}

/// The energy lost in slow impacts (J).
double TimeStepping::lost_by_impacts(const Step& step) {
  double lost = 0;
  for (std::size_t k = 0; k < step.x.size(); ++k) {
    const Vec3& v = step.after_impacts[k];
    lost += 0.5 * (step.v[k] - v).dot(step.v[k] + v) / step.inverse_mass[k];
  }
  for (const ContactConstraint& p : step.impacts) lost += p.work();
  return lost;
}

/// The work of forces on pairs that separate (J).
double TimeStepping::parting_work(const Step& step) {
  double work = 0;
  for (const ContactConstraint& p : step.contacts.pairs) work += p.force * std::max(p.target, 0.0);
  return work;
}

/// Whether the step makes energy. free: its velocities without contact (m/s).
bool TimeStepping::makes_energy(const Step& step, const std::vector<Vec3>& free) const {
  double made = 0;  // J
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Vec3 &v = step.after_impacts[k], &solved = step.solved[k];
    const double drag = step.length * bodies_.fade[step.members[k]];
    const Vec3 forced = free[k] - v + drag * (free[k] - solved);  // m/s
    made += (0.5 * (solved - v).dot(solved + v) - forced.dot(solved)) / step.inverse_mass[k];
  }
  for (const ContactConstraint& p : step.contacts.pairs) made -= p.work();
  return made > 0;
}

/// Finds the islands of members that press on each other. Margins are the wider, the faster an island's fastest body
/// is.
void TimeStepping::find_parts(Step& step) {
  const std::size_t n = step.x.size();
  const auto presses = [&](std::size_t c) {
    return step.contacts.pairs[c].force > 0 || (!step.impacts.empty() && step.impacts[c].force > 0);
  };
  step.carried.assign(n, 0);
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (!presses(c)) continue;
    step.carried[p.a] = 1;
    if (p.b != ContactConstraint::fixed) step.carried[p.b] = 1;
  }

  const std::vector<std::uint32_t>& island = step.island = connected_parts(n, step.contacts.pairs, presses);
  std::vector<double> margin(n, tol::least_margin * step.smallest);  // m, by island
  const auto widen = [&](std::uint32_t k, double gap) { margin[island[k]] = std::max(margin[island[k]], gap); };
  for (std::uint32_t k = 0; k < n; ++k) {
    widen(k, tol::margin_decay * group_.member[step.members[k]].margin);
    widen(k, tol::margin_of_displacement * step.length * step.solved[k].norm());
  }
  for (const ContactConstraint& p : step.contacts.pairs) {
    const double missing = step.length * (p.target + approach(step.solved, p));  // m
    if (missing > 0) widen(p.a, std::min(2 * missing, tol::widest_margin * step.smallest));
  }
  for (std::uint32_t k = 0; k < n; ++k) group_.member.write(step.members[k]).margin = margin[island[k]];
}

/// By island: whether all its bodies are carried and hardly move. In a jam, slow bodies are stopped.
std::vector<std::uint8_t> TimeStepping::stop_slow(Step& step) const {
  const std::size_t n = step.x.size();
  std::vector<std::uint8_t> still(n);
  for (std::uint32_t k = 0; k < n; ++k) still[k] = step.island[k] == k;
  const double unit = std::sqrt(step.greatest * step.smallest);  // m/s
  const double slow = std::max(tol::standstill * unit, 16 * tol::least_margin * step.smallest / step.length);
  // The rim of a thing that moves may come along.
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c)
    if (bodies_.moving.moves(step.contacts.names[c].e, bodies_.now)) still[step.island[step.contacts.pairs[c].a]] = 0;
  const std::vector<std::uint8_t> may_stop = still;
  const bool jammed = step.short_steps > tol::many_short_steps;
  for (std::uint32_t k = 0; k < n; ++k) {
    Vec3& v = step.solved[k];
    if (jammed && may_stop[step.island[k]] && step.carried[k] && v.norm() <= tol::jammed_speed * unit) v.setZero();
    if (!step.carried[k] || v.norm() > slow) still[step.island[k]] = 0;
  }
  return still;
}

/// Computes the forces among the bodies of still islands, starting from none. Where they are not unique, they are then
/// no greater than necessary.
TimeStepping::Holding TimeStepping::hold(const Step& step, const std::vector<std::uint8_t>& still) {
  Holding holding;
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (!still[step.island[p.a]] || step.contacts.gaps[c] > tol::resting_gap * step.smallest) continue;
    holding.pairs.push_back({p.a, p.b, p.normal, 0, tol::rest_slack * step.greatest, 0});
    holding.which.push_back(c);
  }
  for (const Entity i : step.members) holding.a.push_back(bodies_.applied[i]);
  bodies_.log.note(carom::solve({step.inverse_mass, holding.a, holding.pairs, ContactAccuracy::contacts}));
  return holding;
}

/// Replaces forces within their slack by exact ones, which remain while the islands are at rest.
void TimeStepping::take_exact_forces(const Step& step, Holding& holding) const {
  std::vector<Vec3> a;
  for (const Entity i : step.members) a.push_back(bodies_.applied[i]);
  std::vector<ContactConstraint> pairs = holding.pairs;
  const Certificate certificate = carom::solve({step.inverse_mass, a, pairs, ContactAccuracy::rounding, true});
  if (certificate.solved()) holding.pairs = std::move(pairs);
}

/// Puts to rest the islands that hardly move and that forces hold in balance.
void TimeStepping::put_to_rest(Step& step) {
  const std::size_t n = step.x.size();
  step.rests.assign(n, 0);
  std::vector<std::uint8_t> still = stop_slow(step);
  if (std::find(still.begin(), still.end(), 1) == still.end()) return;
  Holding holding = hold(step, still);
  for (std::uint32_t k = 0; k < n; ++k)
    if (!(holding.a[k].norm() <= tol::balance * step.greatest)) still[step.island[k]] = 0;
  // A body that rests on a sleeping body wakes it first. They are in balance together, or not at all.
  for (std::size_t c = 0; c < holding.pairs.size(); ++c) {
    const Entity e = step.contacts.names[holding.which[c]].e;
    if (holding.pairs[c].force > 0 && bodies_.world.is_body(e) && holding.pairs[c].b == ContactConstraint::fixed) {
      still[step.island[holding.pairs[c].a]] = 0;
      step.contacts.pairs[holding.which[c]].force =
          std::max(step.contacts.pairs[holding.which[c]].force, step.length * holding.pairs[c].force);
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) step.rests[k] = still[step.island[k]];
  if (std::ranges::find(step.rests, 1) != step.rests.end()) take_exact_forces(step, holding);
  for (ContactConstraint& p : step.contacts.pairs)
    if (step.rests[p.a]) p.force = 0;
  for (std::size_t c = 0; c < holding.pairs.size(); ++c)
    if (step.rests[holding.pairs[c].a])
      step.contacts.pairs[holding.which[c]].force = step.length * holding.pairs[c].force;
}

/// Counts the impacts of pairs with gaps that close within the step. The force between the two takes away their
/// approach in the course of the step. Together they take no more energy than the step does, because its weights do
/// work along paths that they shorten.
void TimeStepping::take_closings(Step& step) {
  step.taking.assign(step.members.size(), 0);
  double fastest = 0, all = 0;  // m/s, J
  for (const Vec3& v : step.after_impacts) fastest = std::max(fastest, v.norm());
  for (const ContactConstraint& p : step.contacts.pairs) {
    const double speed = approach(step.after_impacts, p);
    if (!(p.force > 0 && speed > std::max(tol::drift * fastest, p.slack))) continue;
    bodies_.log.take_up(speed, 0);
    // J, by the mean speed.
    const double lost = 0.5 * p.force * (speed + approach(step.solved, p));
    step.taking[p.a] += lost / step.length;
    all += lost;
  }
  if (all == 0) return;
  const double share = std::clamp(taken(step) / all, 0.0, 1.0);
  for (double& power : step.taking) power *= share;
}

/// The energy that contact takes from carried members in the step (J).
double TimeStepping::taken(const Step& step) const {
  double sum = 0;
  for (std::size_t k = 0; k < step.members.size(); ++k) {
    if (!step.carried[k]) continue;
    const Entity i = step.members[k];
    const Vec3 &v = step.after_impacts[k], &solved = step.solved[k];
    const Vec3 forced = step.length * (bodies_.applied[i] - bodies_.fade[i] * solved);  // m/s
    sum += (0.5 * (v - solved).dot(v + solved) + forced.dot(solved)) / step.inverse_mass[k];
  }
  for (const ContactConstraint& p : step.contacts.pairs) sum += p.work();
  return sum;
}

/// Starts the members' flights until the step's end.
void TimeStepping::begin_flights(Step& step) {
  const double h = step.length;
  bodies_.log.take_up(step.inverse_mass, step.v, step.after_impacts, step.impacts);
  take_closings(step);
  for (const Entity i : step.members) group_.pressing.write(i).clear();
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c)
    if (step.contacts.pairs[c].force > 0)
      group_.pressing.write(step.contacts.names[c].i)
          .push_back({step.contacts.names[c].e, step.contacts.pairs[c].force / h, step.contacts.pairs[c].surface});
  if (bodies_.moving.any())
    for (const Entity i : step.members) group_.note_power(i);
  Island& island = bodies_.islands.of(step.members.front());
  island.step_length = h;
  island.shortest_step = step.shortest;
  island.short_steps = step.short_steps;
  island.impact_pairs = 0;
  island.end = bodies_.now + h;
  count_calm(step, island);
  for (const Entity i : step.members) {
    modes_.clear_partners(i);
    modes_.step(i);
  }
  std::vector<Entity> stay;
  for (std::size_t k = 0; k < step.members.size(); ++k)
    if (begin_flight(step, k, step.members[k])) stay.push_back(step.members[k]);
  bodies_.islands.retain(step.members.front(), std::move(stay));
  split(step);
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    const bool asleep = bodies_.world.is_body(e) && bodies_.mode(e) == Mode::asleep;
    if (step.contacts.pairs[c].b != ContactConstraint::fixed || !asleep) continue;
    if (!(step.contacts.pairs[c].force > 0 && is_member(bodies_.mode(i)))) continue;
    group_.wake(e);
    group_.unite(i, e);
  }
}

/// Counts steps in which the same pairs press. After some of them constrained motion can follow the island again.
void TimeStepping::count_calm(const Step& step, Island& island) {
  std::uint64_t hash = 0;
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    if (!(step.contacts.pairs[c].force > 0)) continue;
    const auto& [i, e, feature] = step.contacts.names[c];
    hash += (std::uint64_t{i} << 32 | e) * 0x9e3779b97f4a7c15u;
  }
  island.calm = hash == island.pressing ? island.calm + 1 : 0;
  island.pressing = hash;
  if (island.calm < island.calm_needed) return;
  island.busy = false;
  island.calm = 0;
}

/// Splits off the remaining members that no pair connects. They become islands of their own.
void TimeStepping::split(const Step& step) {
  const Numbering& members = step.members;
  const auto stays = [&](std::uint32_t k) { return is_member(bodies_.mode(members[k])); };
  const std::vector<std::uint32_t> part = connected_parts(members.size(), step.contacts.pairs, [&](std::size_t c) {
    return stays(step.contacts.pairs[c].a) && stays(step.contacts.pairs[c].b);
  });

  // Labels count the members that stay.
  std::vector<std::uint32_t> label;
  std::vector<std::uint32_t> number(members.size());
  for (std::uint32_t k = 0; k < members.size(); ++k) {
    if (!stays(k)) continue;
    number[k] = static_cast<std::uint32_t>(label.size());
    label.push_back(number[part[k]]);
  }
  for (std::uint32_t k = 0; k < members.size(); ++k)
    if (stays(k)) {
      bodies_.islands.split(members[k], label);
      break;
    }
}

/// Body i, member k of the step, falls asleep, leaves its island or continues. Returns whether it stays.
bool TimeStepping::begin_flight(const Step& step, std::size_t k, Entity i) {
  Islands& islands = bodies_.islands;
  const Vec3 &v = step.after_impacts[k], &solved = step.solved[k];
  const Vec3 before = bodies_.velocity(i);
  const auto begin = [&](const Vec3& velocity) {
    bodies_.log.deviate(0.5 * bodies_.world.mass[i] * (before - velocity).dot(before + velocity));
    flights_.begin(i, step.x[k], velocity, {});
    if (may_be_kicked(bodies_.mode(i))) flights_.take(i, step.taking[k]);
  };
  if (step.rests[k]) {
    modes_.fall_asleep(i);
    begin(Vec3::Zero());
    return false;
  }
  const std::uint8_t idle = step.carried[k] ? std::uint8_t{0} : static_cast<std::uint8_t>(group_.member[i].idle + 1);
  group_.member.write(i).idle = idle;
  if (idle >= tol::idle_steps) {
    modes_.leave(i);
    begin(v);
    return false;
  }
  modes_.press(i, step.carried[k] != 0);
  group_.member.write(i).impacts = 0;
  if (step.carried[k]) {
    bodies_.kick.write(i) = {islands.of(i).end,
                             step.greatest > 0 ? Vec3((solved - v) / step.length) : Vec3(Vec3::Zero())};
    begin(solved);
    // The kick contains the effect of forces.
    bodies_.flights.accelerate(i, Vec3::Zero());
  } else {  // flies as free bodies do
    bodies_.kick.write(i) = {bodies_.now};
    begin(v);
    flights_.let_fall(i);
  }
  return true;
}

}  // namespace carom
