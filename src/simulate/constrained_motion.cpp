// Constrained motion of an island by event-driven integration (Acary & Brogliato, Numerical Methods for Nonsmooth
// Dynamical Systems, 2008, ch. 8). A step closes overlaps, takes away approaches, computes forces and picks a motion:
// parabolas where they are exact, otherwise a method of order 8, whose dense output is the bodies' flight. It ends at
// the first change of contact. An island with too many changes in the time of a time step is left to time stepping.
#include "simulate/constrained_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/path_time_of_impact.h"
#include "numerics/disjoint_sets.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/collapse_detector.h"
#include "simulate/exact_group.h"
#include "simulate/flat_contacts.h"
#include "simulate/flight_changes.h"
#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Keeps a speed above zero, so that products divided by it stay finite.
double at_least_tiny(double fastest) {
  return std::max(fastest, 0x1p-900);
}

}  // namespace

ConstrainedMotion::ConstrainedMotion(ExactBodies& bodies, Modes& modes, ExactGroup& group, FlatContacts& flat,
                                     CollapseDetector& collapses, FlightChanges& flights)
    : bodies_(bodies),
      modes_(modes),
      group_(group),
      flat_(flat),
      collapses_(collapses),
      flights_(flights),
      following_(bodies.body.size()) {}

Vec3 ConstrainedMotion::at(const std::vector<Vec3>& x, Entity e) const {
  const Entity b = bodies_.world.second_body(e);
  return b != no_entity ? x[group_.index[b]] : bodies_.fixed_position(e);
}

Vec3 ConstrainedMotion::rate(const std::vector<Vec3>& v, Entity e) const {
  const Entity b = bodies_.world.second_body(e);
  return b != no_entity ? v[group_.index[b]] : bodies_.fixed_velocity(e);
}

Vec3 ConstrainedMotion::acceleration(const std::vector<Vec3>& a, Entity e) const {
  const Entity b = bodies_.world.second_body(e);
  return b != no_entity ? a[group_.index[b]] : Vec3(Vec3::Zero());
}

void ConstrainedMotion::clear_index(const std::vector<Entity>& members) const {
  for (const Entity i : members) group_.index.write(i) = ContactConstraint::fixed;
}

/// Whether body i follows a path that is not a parabola.
bool ConstrainedMotion::follows(Entity i) const {
  const Following& following = following_[i];
  return following.path && following.version == bodies_.body[i].version;
}

/// Counts a change of the contacts of a step's island. Returns whether the changes in the time of a time step are not
/// too many.
bool ConstrainedMotion::count_change(const Step& step) const {
  Island& island = bodies_.islands.of(step.members.front());
  if (step.greatest == 0 || island.changed == bodies_.now) return true;
  if (bodies_.now - island.counted > tol::shortest_step * std::sqrt(2 * step.smallest / step.greatest)) {
    island.counted = bodies_.now;
    island.changes = 0;
  }

  island.changed = bodies_.now;
  if (++island.changes <= tol::many_changes) return true;
  island.busy = true;
  island.changes = 0;
  island.calm = 0;
  island.calm_needed = island.calm_needed == 0 ? tol::calm_steps : 2 * island.calm_needed;
  return false;
}

/// Of the usual error of a step, the share that is asked for. What else counts as rounding is as much smaller, or a run
/// with smaller errors would not show what it does. Contacts allow for no greater errors.
double ConstrainedMotion::step_share() const {
  return std::min(1.0, bodies_.options.step_error / tol::step_error);
}

bool ConstrainedMotion::advance(Entity i) {
  const Island& island = bodies_.islands.of(i);
  const bool undisturbed = bodies_.mode(i) == Mode::held && bodies_.now == island.planned;
  const bool may_be_busy = !undisturbed && !bodies_.any_taut(island.members);
  if (!undisturbed) take_in_touching(i);
  std::vector<Entity>& all = bodies_.islands.of(i).members;
  std::sort(all.begin(), all.end());
  const std::vector<Entity> members = all;

  Step step = begin_step(members);
  find_contacts(step);
  if (may_be_busy && !count_change(step)) {
    clear_index(members);
    return false;
  }

  const std::vector<std::uint32_t> part = parts_of(step);
  if (std::all_of(part.begin(), part.end(), [](std::uint32_t first) { return first == 0; })) {
    step.undisturbed = undisturbed;
    advance_whole(step);
    return true;
  }

  clear_index(members);
  for (const Entity first : bodies_.islands.split(i, part)) {
    Step of_part = begin_step(bodies_.islands.of(first).members);
    of_part.undisturbed = undisturbed;
    find_contacts(of_part);
    advance_whole(of_part);
  }
  return true;
}

/// Adds bodies that touch a member without approach or separation, where nothing presses. They take part in its motion.
/// Impacts that end in contact would otherwise be resolved one after the other, down to what rounding leaves of them.
void ConstrainedMotion::take_in_touching(Entity i) {
  const World& world = bodies_.world;
  std::vector<Entity> todo = bodies_.islands.of(i).members;
  while (!todo.empty()) {
    const Entity k = todo.back();
    todo.pop_back();
    if (!bodies_.falls_freely(k)) continue;
    const Vec3 x = bodies_.position(k), v = bodies_.velocity(k);
    for (const Entity e : bodies_.neighbours_of(k)) {
      if (!world.is_body(e) || !is_free(bodies_.mode(e))) continue;
      if (!bodies_.falls_freely(e) || bodies_.applied[e] != bodies_.applied[k]) continue;
      const Vec3 xe = bodies_.position(e), ve = bodies_.velocity(e);
      const Touch there = touch(world, k, x, e, xe);
      if (there.gap > bodies_.contact_gap(k, x, xe)) continue;
      if (std::abs(there.normal.dot(ve - v)) > tol::drift * (v.norm() + ve.norm())) continue;
      group_.join(e);
      group_.unite(i, e);
      todo.push_back(e);
    }
  }
}

/// By member: the first of the members that contacts connect with it.
std::vector<std::uint32_t> ConstrainedMotion::parts_of(const Step& step) const {
  const std::size_t n = step.members.size();
  DisjointSets sets(n);
  for (const ContactConstraint& p : step.contacts.pairs)
    if (p.b != ContactConstraint::fixed) sets.join(p.a, p.b);
  std::vector<std::uint32_t> part(n), first(n, ContactConstraint::fixed);
  for (std::uint32_t k = 0; k < n; ++k) {
    std::uint32_t& of_part = first[sets.root(k)];
    of_part = std::min(of_part, k);
    part[k] = of_part;
  }
  return part;
}

/// The next step of an island with connected contacts.
void ConstrainedMotion::advance_whole(Step& step) {
  close_overlaps(step);
  take_approaches(step);
  drop_parting(step);
  ConstrainedSystem system = find_forces(step);
  find_resting(step);
  choose_motion(step, system);
  note_contacts(step);
  clear_index(step.members);
  begin_flights(step);
}

/// The positions and velocities of the members.
ConstrainedMotion::Step ConstrainedMotion::begin_step(std::vector<Entity> members) const {
  const Islands& islands = bodies_.islands;
  Step step;
  step.members = std::move(members);
  for (const Entity i : step.members) {
    group_.index.write(i) = static_cast<std::uint32_t>(step.x.size());
    step.x.push_back(bodies_.position(i));
    Vec3 v = bodies_.velocity(i);
    if (follows(i)) {
      const Path& path = *following_[i].path;
      const std::uint32_t place = following_[i].place;
      const double t = bodies_.now - path.start;
      step.x.back() = path.motion->start(place) + path.motion->displacement(place, t);
      v = path.motion->velocity(place, t);
    } else if (bodies_.mode(i) != Mode::held && bodies_.now < islands.kicked_until[i]) {
      v -= (islands.kicked_until[i] - bodies_.now) * islands.kick[i];
    }
    step.v.push_back(v);
    step.inverse_mass.push_back(1 / bodies_.world.mass[i]);
    bodies_.refresh(i, step.x.back(), step.v.back());
    step.smallest = std::min(step.smallest, bodies_.world.radius[i]);
  }
  return step;
}

/// Finds the pairs in contact, except those that are about to strike, and the load.
void ConstrainedMotion::find_contacts(Step& step) const {
  find_touching(step);
  step.greatest = load_of(step);
  drop_striking(step);
}

/// The greatest acceleration by forces with which members may press on anything (m/s^2). Without a fixed thing in
/// contact it is that relative to one another, because what falls freely presses on nothing.
double ConstrainedMotion::load_of(const Step& step) const {
  const std::vector<ContactConstraint>& pairs = step.contacts.pairs;
  const bool held = std::any_of(pairs.begin(), pairs.end(),
                                [](const ContactConstraint& p) { return p.b == ContactConstraint::fixed; });
  const auto pull = [&](std::size_t k) { return bodies_.force_at(step.members[k], step.x[k], step.v[k]); };
  const Vec3 common = held ? Vec3(Vec3::Zero()) : pull(0);
  double greatest = 0;
  for (std::size_t k = 0; k < step.members.size(); ++k) greatest = std::max(greatest, (pull(k) - common).norm());
  return greatest;
}

/// Drops the pairs that are about to strike: they approach too fast for the force that pressed them together last.
void ConstrainedMotion::drop_striking(Step& step) const {
  ContactList& contacts = step.contacts;
  for (std::size_t c = 0; c < contacts.pairs.size(); ++c) {
    const ContactConstraint& p = contacts.pairs[c];
    const auto& [i, e, feature] = contacts.names[c];
    const double of_e = p.b == ContactConstraint::fixed ? 0 : step.inverse_mass[p.b];
    const double press = group_.pressing_force(i, e) * (step.inverse_mass[p.a] + of_e);  // m/s^2
    // A pair that nothing has pressed together decides by its impact. An error of paths is none.
    const bool pressed = press > tol::curve_rounding * step.greatest;
    const double slow = pressed ? bodies_.slow_speed(press, bodies_.smaller_length(i, e)) : 0;
    const double errors = bodies_.drift_of(i, step.v[p.a], rate(step.v, e));
    contacts.slow[c] = std::max({slow, errors, std::numeric_limits<double>::min()});
  }

  contacts.drop_if(0, [&](std::size_t c) {
    const ContactConstraint& p = contacts.pairs[c];
    const auto& [i, e, feature] = contacts.names[c];
    const double approach = p.normal.dot(step.v[p.a] - rate(step.v, e));
    const double rounding = tol::contact_rounding * (step.x[p.a].cwiseAbs().sum() + at(step.x, e).cwiseAbs().sum());
    return !p.bilateral && group_.strikes(i, e, approach, contacts.slow[c], contacts.gaps[c] > rounding);
  });
}

/// The pairs that touch.
void ConstrainedMotion::find_touching(Step& step) const {
  const World& world = bodies_.world;
  for (std::size_t k = 0; k < step.members.size(); ++k) {
    const Entity i = step.members[k];
    const std::size_t first = step.contacts.pairs.size();
    for (const Entity e : bodies_.neighbours_of(i)) {
      const bool body = world.is_body(e);
      if (body && (e < i || group_.index[e] == ContactConstraint::fixed)) continue;
      // A thing that it has just struck touches it at that feature, and at no other.
      const bool struck = bodies_.flights[i].start == bodies_.now && bodies_.body[i].origin_partner == e;
      const Vec3 xe = at(step.x, e);
      const Touch there = touch(world, i, step.x[k], e, xe, struck ? bodies_.body[i].origin_feature : no_feature);
      if (there.gap > bodies_.contact_gap(i, step.x[k], xe)) continue;
      const std::uint32_t other = body ? group_.index[e] : ContactConstraint::fixed;
      step.contacts.add({static_cast<std::uint32_t>(k), other, there.normal, -there.gap, 0, 0}, {i, e, there.feature},
                        there.gap);
    }
    step.contacts.drop_hidden(bodies_, step.x[k], first);
    find_strings(step, k);
  }
}

/// The same for the strings of member k. Each belongs to one of its two bodies. A rod is always in contact.
void ConstrainedMotion::find_strings(Step& step, std::size_t k) const {
  const Entity i = step.members[k];
  for (const Entity e : bodies_.ties.of(i)) {
    const String& s = bodies_.world.string(e);
    const std::uint32_t other = s.other == no_entity ? ContactConstraint::fixed : group_.index[s.other];
    if (s.body != i || (s.other != no_entity && other == ContactConstraint::fixed)) continue;
    const Vec3 xe = at(step.x, e);
    const Touch there = touch(bodies_.world, i, step.x[k], e, xe);
    if (!s.rod && there.gap > bodies_.contact_gap(i, step.x[k], xe)) continue;
    ContactConstraint pair{static_cast<std::uint32_t>(k), other, there.normal, -there.gap};
    pair.bilateral = s.rod;
    pair.slack = s.rod ? tol::step_error * bodies_.world.radius[i] : 0;
    step.contacts.add(pair, {i, e, there.feature}, there.gap);
  }
}

void ConstrainedMotion::close_overlaps(Step& step) const {
  bool overlap = false;
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const double closes = p.bilateral ? std::abs(p.target) : p.target;
    overlap = overlap || closes > tol::least_overlap * bodies_.world.radius[step.contacts.names[c].i];
  }
  if (!overlap) return;
  std::vector<Vec3> displacement(step.x.size(), Vec3::Zero());  // m
  bodies_.log.note(solve({step.inverse_mass, displacement, step.contacts.pairs}));
  for (std::size_t k = 0; k < step.x.size(); ++k) step.x[k] += displacement[k];
}

/// Contact takes away the approach of pairs. A struck body that others behind it hold up has an impact in turn with the
/// strike, as with e = 0.
void ConstrainedMotion::take_approaches(Step& step) {
  for (const Vec3& v : step.v) step.fastest = std::max(step.fastest, v.norm());
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    ContactConstraint& p = step.contacts.pairs[c];
    p.target = p.force = 0;
    p.slack = p.bilateral ? tol::step_error * step.fastest : 0;
    p.surface = surface_speed(p.normal, step.contacts.names[c].e);
  }
  const std::vector<Vec3> met = step.v;
  const Certificate certificate = solve({step.inverse_mass, step.v, step.contacts.pairs});
  if (certificate.verdict == Certificate::Verdict::infeasible) step.contacts.check_room(bodies_, step.v);
  bodies_.log.note(certificate);
  std::vector<AbsorbedImpact> absorbed = absorbed_impacts(step, met);
  record_fast(step, absorbed);
  bodies_.log.take_up(step.inverse_mass, met, step.v, step.contacts.pairs, absorbed);
  for (std::size_t k = 0; k < step.v.size(); ++k) {
    const Entity i = step.members[k];
    const Vec3 before = bodies_.velocity(i);
    if (group_.needed[i] < bodies_.now || (step.v[k] - before).norm() <= tol::velocity_change * before.norm()) continue;
    collapses_.count_in_turn(i, 1);
  }
}

/// The speed of a thing along the normal (m/s), if it is a fixed thing that moves.
double ConstrainedMotion::surface_speed(const Vec3& normal, Entity e) const {
  return bodies_.world.moves(e) ? normal.dot(bodies_.fixed_velocity(e)) : 0;
}

/// By pair: the impacts at velocities `met` (m/s) that contact has just absorbed. A pair that a struck body closes has
/// its impact after that body's, and each takes energy from the velocities that it meets.
std::vector<AbsorbedImpact> ConstrainedMotion::absorbed_impacts(const Step& step, const std::vector<Vec3>& met) const {
  const std::vector<ContactConstraint>& pairs = step.contacts.pairs;
  const double errors = tol::drift * step.fastest;  // m/s
  // A rod may push, which is a pull along the other direction.
  const auto speed_of = [](const std::vector<Vec3>& v, const ContactConstraint& p) {
    return p.bilateral ? std::abs(approach(v, p)) : approach(v, p);
  };
  std::vector<AbsorbedImpact> impacts(pairs.size());
  double all = 0;  // J, lost by all of them
  bool closed_later = false;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    impacts[c].approach = speed_of(met, pairs[c]);
    impacts[c].lost = 0.5 * pairs[c].force * approach(met, pairs[c]);
    all += impacts[c].lost;
    closed_later = closed_later || (pairs[c].force > 0 && impacts[c].approach < -errors);
  }
  if (!closed_later) return impacts;

  // One round after the other, of the pairs that approach by then and of those before.
  for (AbsorbedImpact& impact : impacts) impact = {};
  double in_rounds = 0;  // J
  std::vector<Vec3> v = met;
  std::vector<std::size_t> which;
  std::vector<std::uint8_t> taken(pairs.size(), 0);
  for (;;) {
    const std::size_t before = which.size();
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      if (taken[c] || !(speed_of(v, pairs[c]) > errors)) continue;
      taken[c] = 1;
      which.push_back(c);
      impacts[c].approach = speed_of(v, pairs[c]);
    }
    if (which.size() == before) break;

    std::vector<ContactConstraint> rows;
    for (const std::size_t c : which) rows.push_back(pairs[c]);
    const std::vector<Vec3> first = v;
    solve({step.inverse_mass, v, rows});
    for (std::size_t k = 0; k < which.size(); ++k) {
      const double lost = std::max(0.5 * rows[k].force * (approach(first, rows[k]) + approach(v, rows[k])), 0.0);
      impacts[which[k]].lost += lost;
      in_rounds += lost;
    }
  }

  // Impulses of one round may end in a later one. Energy is that of all together.
  for (AbsorbedImpact& impact : impacts) impact.lost *= in_rounds > 0 ? std::max(all, 0.0) / in_rounds : 0;
  return impacts;
}

/// Records the absorbed impacts that were not slow: those that struck bodies passed on at once.
void ConstrainedMotion::record_fast(const Step& step, std::vector<AbsorbedImpact>& impacts) const {
  const World& world = bodies_.world;
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const auto& [i, e, feature] = step.contacts.names[c];
    const bool presses = p.force > 0 || (p.bilateral && p.force < 0);
    const double slow = step.greatest > 0 ? bodies_.slow_speed(step.greatest, bodies_.smaller_length(i, e)) : 0;
    if (!(presses && impacts[c].approach > std::max(slow, step.contacts.slow[c]))) continue;

    const double sign = p.force < 0 ? -1 : 1;
    const CollisionKind kind = world.is_string(e) ? CollisionKind::string
                               : world.is_body(e) ? CollisionKind::body_body
                                                  : CollisionKind::body_fixed;
    const Touch there = touch(world, i, step.x[p.a], e, at(step.x, e), feature);
    Collision taken = make_collision(world, kind, bodies_.now.hi, i, e, there.point, sign * p.normal,
                                     impacts[c].approach, 0, pair_restitution(world, i, e));
    // Shared among all struck bodies.
    taken.impulse = sign * p.force;
    taken.energy_lost = impacts[c].lost;
    bodies_.log.record(taken);
    impacts[c].recorded = true;
  }
}

/// The speed (m/s) at which path errors let pairs separate. Strings hold by their curvature where nothing else pulls.
double ConstrainedMotion::parting_speed(const Step& step) const {
  const bool tied = std::any_of(step.contacts.names.begin(), step.contacts.names.end(),
                                [&](const auto& name) { return bodies_.world.is_string(name.e); });
  return std::sqrt(2 * step.greatest * tol::step_error * step.smallest) +
         (tied ? tol::drift : tol::velocity_rounding) * step.fastest;
}

/// Pairs that separate by more than path errors are not contacts. If they return, they meet.
void ConstrainedMotion::drop_parting(Step& step) const {
  const double parting = parting_speed(step);
  step.contacts.drop_if(0, [&](std::size_t c) {
    if (step.contacts.pairs[c].bilateral) return false;
    const Vec3 w = rate(step.v, step.contacts.names[c].e) - step.v[step.contacts.pairs[c].a];
    return step.contacts.pairs[c].normal.dot(w) > parting;
  });
}

/// Computes the accelerations and forces at the step's start. Contacts that separate and carry no force open.
/// They are watched until they are wide enough to meet again.
ConstrainedSystem ConstrainedMotion::find_forces(Step& step) const {
  std::vector<ConstrainedSystem::Applied> applied;
  for (const Entity i : step.members) applied.push_back({bodies_.applied[i], bodies_.fade[i], bodies_.bent[i] != 0});
  ConstrainedSystem system(bodies_.world, bodies_.now.hi, step.members, std::move(applied),
                           step_share() * tol::step_error);
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const Entity e = step.contacts.names[c].e;
    if (bodies_.world.moves(e)) system.carry(e, bodies_.fixed_position(e), bodies_.fixed_velocity(e));
    system.add(step.contacts.names[c], step.contacts.pairs[c], group_.pressing_force(step.contacts.names[c].i, e));
  }

  step.a = system.accelerate(step.x, step.v);
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) step.contacts.pairs[c].force = system.rows()[c].force;
  if (stop_parting(step)) {
    step.a = system.accelerate(step.x, step.v);
    for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) step.contacts.pairs[c].force = system.rows()[c].force;
  }
  const ConstrainedSystem::Scales scales = system.scales(step.x, step.v);
  check_digits(step, scales.acceleration);
  std::vector<std::uint8_t> opens(step.contacts.pairs.size(), 0);
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (p.force > 0 || p.bilateral) continue;
    const double parting = p.normal.dot(rate(step.v, step.contacts.names[c].e) - step.v[p.a]);
    opens[c] = parting > tol::drift * scales.speed || system.gap_acceleration(c, step.a) > scales.opening;
  }
  system.open(opens);
  bodies_.log.note(system.certificate());
  return system;
}

/// Throws SimulationError where strings and contacts work against one another with forces so great that rounding makes
/// a noticeable part of the accelerations (m/s^2). Those would then be arbitrary: the bodies are jammed. Rounding is
/// that of the force, and that of positions, which turns the string's direction.
void ConstrainedMotion::check_digits(const Step& step, double acceleration) const {
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    if (!bodies_.world.is_string(e)) continue;
    const ContactConstraint& p = step.contacts.pairs[c];
    const double inverse_mass =
        std::max(step.inverse_mass[p.a], p.b == ContactConstraint::fixed ? 0.0 : step.inverse_mass[p.b]);
    const double by_force = std::abs(p.force) * inverse_mass;  // m/s^2
    const double noticeable = tol::arbitrary * acceleration;   // m/s^2
    const double turn = turn_by_rounding(step, c);
    // Forces are great where a motion is across almost all pairs that bear. An error along them is then one across them
    // that is greater by as much as the force is than what acts: such an estimate is cheap.
    const bool doubtful = by_force * turn * by_force > noticeable * acceleration;
    // Great forces on light bodies are no contradiction. A frame with more rods than it needs has no such motion.
    const double magnified = doubtful ? leverage(step, c) : 0;
    if (0x1p-53 * by_force > noticeable || (magnified < never && by_force * turn * magnified > noticeable))
      fail_jammed(i, std::abs(p.force));
  }
}

/// The angle (radians) by which the rounding of positions turns the pair's string.
double ConstrainedMotion::turn_by_rounding(const Step& step, std::size_t pair) const {
  const ContactConstraint& p = step.contacts.pairs[pair];
  const Entity e = step.contacts.names[pair].e;
  return 0x1p-53 * (step.x[p.a].cwiseAbs().sum() + at(step.x, e).cwiseAbs().sum()) / bodies_.world.string(e).length;
}

/// Throws SimulationError where a string's direction decides whether bodies can move, and rounding decides on that.
void ConstrainedMotion::check_directions(const Step& step) const {
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    if (bodies_.world.is_string(e) && turn_by_rounding(step, c) * leverage(step, c) > tol::arbitrary)
      fail_jammed(i, std::abs(step.contacts.pairs[c].force));
  }
}

/// How far the pair's closing by a unit moves bodies while all others that bear stay closed. Infinity: they keep it
/// from closing.
double ConstrainedMotion::leverage(const Step& step, std::size_t pair) const {
  std::vector<ContactConstraint> bearing;
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    ContactConstraint p = step.contacts.pairs[c];
    if (p.force == 0 && c != pair) continue;
    p.bilateral = true;
    p.target = c == pair ? 1 : 0;
    p.force = p.slack = p.surface = 0;
    bearing.push_back(p);
  }
  std::vector<Vec3> moved(step.x.size(), Vec3::Zero());
  solve({step.inverse_mass, moved, bearing});
  for (const ContactConstraint& p : bearing)
    if (std::abs(approach(moved, p) + p.target) > 0.25) return never;
  double farthest = 0;
  for (const Vec3& u : moved) farthest = std::max(farthest, u.norm());
  return farthest;
}

/// `force`: of a string of body i, in N.
void ConstrainedMotion::fail_jammed(Entity i, double force) const {
  const char* motion = bodies_.moving.any() ? "end or slow `motion` before, or " : "";
  throw SimulationError(fmt::format("at t = {} s the strings and contacts of ", bodies_.now.hi), i,
                        fmt::format(" work against one another, with a force of {:.3g} N that rounding makes arbitrary "
                                    "(jammed): {}let lengths of strings differ from those that just fit",
                                    force, motion));
}

/// Removes the small remaining speed of separation of pairs that press, without making any pair approach. This takes no
/// more energy than path errors may have made. Where contacts almost lock a motion, it would stop it: the separation
/// then remains. Returns whether any was removed.
bool ConstrainedMotion::stop_parting(Step& step) const {
  std::vector<ContactConstraint> kept;
  bool parts = false;
  const double rounding = step_share() * tol::velocity_rounding * step.fastest;  // m/s
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const double speed = p.normal.dot(rate(step.v, step.contacts.names[c].e) - step.v[p.a]);
    parts = parts || (p.force > 0 && speed > rounding);
    kept.push_back({p.a, p.b, p.normal});
    kept.back().bilateral = p.force > 0 || p.bilateral;
    kept.back().slack = p.slack;
    kept.back().surface = p.surface;
  }
  if (!parts) return false;
  std::vector<Vec3> stopped = step.v;  // m/s
  const Certificate certificate = solve({step.inverse_mass, stopped, kept});
  const double errors = parting_speed(step) * (step.fastest + std::sqrt(step.greatest * step.smallest));  // m^2/s^2
  double taken = 0, made = 0;                                                                             // J, twice
  for (std::size_t k = 0; k < step.v.size(); ++k) {
    taken += (stopped[k] - step.v[k]).squaredNorm() / step.inverse_mass[k];
    made += errors / step.inverse_mass[k];
  }
  if (!(taken <= made)) return false;
  step.v = std::move(stopped);
  bodies_.log.note(certificate);
  double work = 0;
  for (const ContactConstraint& p : kept) work += p.work();
  if (work != 0) bodies_.log.carry(work);
  return true;
}

/// Islands in which no body moves or accelerates are at rest.
void ConstrainedMotion::find_resting(Step& step) const {
  const std::size_t n = step.x.size();
  DisjointSets islands(n);
  for (const ContactConstraint& p : step.contacts.pairs)
    if (p.b != ContactConstraint::fixed) islands.join(p.a, p.b);
  std::vector<std::uint32_t> island(n);
  for (std::uint32_t k = 0; k < n; ++k) island[k] = islands.root(k);
  std::vector<std::uint8_t> moves(n, 1);  // by island
  for (const ContactConstraint& p : step.contacts.pairs) moves[island[p.a]] = 0;
  // Its rim may come along.
  for (const auto& [i, e, feature] : step.contacts.names)
    if (bodies_.moving.moves(e, bodies_.now)) moves[island[group_.index[i]]] = 1;
  step.fastest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double speed = step.v[k].norm();
    step.fastest = std::max(step.fastest, speed);
    // What drag alone balances goes on.
    const Entity i = step.members[k];
    const Vec3 drag = bodies_.force_at(i, step.x[k], step.v[k]) - bodies_.force_at(i, step.x[k], Vec3::Zero());
    if (!(speed <= tol::drift * std::sqrt(step.greatest * step.smallest) &&
          (step.a[k] - drag).norm() <= tol::constrained_balance * step.greatest))
      moves[island[k]] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) step.rests.push_back(!moves[island[k]]);
  note_unbalanced(step);
}

/// Notes accelerations of members at rest that are more than the rounding of forces and of their directions.
void ConstrainedMotion::note_unbalanced(const Step& step) const {
  std::vector<double> rounding(step.x.size(), tol::velocity_rounding * step.greatest);  // m/s^2
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const double places = step.x[p.a].cwiseAbs().sum() + at(step.x, step.contacts.names[c].e).cwiseAbs().sum();
    const double of_force =
        std::abs(p.force) * (tol::velocity_rounding + tol::contact_rounding * places / step.smallest);
    // A rod's force has an allowed error.
    const double of_rod = p.bilateral ? tol::step_error * step.greatest : 0;
    for (const std::uint32_t k : {p.a, p.b})
      if (k != ContactConstraint::fixed) rounding[k] += of_force * step.inverse_mass[k] + of_rod;
  }
  const double left = Instant{bodies_.options.duration, 0} - bodies_.now;
  for (std::size_t k = 0; k < step.x.size(); ++k) {
    const double a = step.a[k].norm();
    if (step.rests[k] && a > rounding[k]) bodies_.log.note_unbalanced({a, 0.5 * a * left * left, step.members[k]});
  }
}

/// The longest step (s). It ends when a body may leave the group, otherwise beyond the run's end.
double ConstrainedMotion::longest(Step& step) const {
  double h = 2 * (Instant{bodies_.options.duration, 0} - bodies_.now) +
             (step.greatest > 0 ? tol::first_step * std::sqrt(step.smallest / step.greatest)
                                : tol::first_step * step.smallest / at_least_tiny(step.fastest));
  step.grace = step.greatest > 0 ? 2 * bodies_.slow_speed(step.greatest, step.smallest) / step.greatest
                                 : tol::free_time * step.smallest / at_least_tiny(step.fastest);
  find_unbound(step);
  for (std::size_t k = 0; k < step.x.size(); ++k)
    if (leaves(step, k))
      h = std::min(h, std::max(step.grace - (bodies_.now - group_.needed[step.members[k]]), 0.25 * step.grace));
  return h;
}

/// Takes parabolas, for as long as they are the paths, or a step of the method.
void ConstrainedMotion::choose_motion(Step& step, ConstrainedSystem& system) {
  const ConstrainedSystem::Scales scales = system.scales(step.x, step.v);
  step.length = longest(step);
  const bool all_rest = std::find(step.rests.begin(), step.rests.end(), 0) == step.rests.end();
  const double straight = all_rest ? step.length : system.straight_time(step.x, step.v, step.a);
  if (straight >= std::min(step.length, scales.time())) {
    if (straight < never && !all_rest) ++inexact_steps_;
    step.length = std::min(step.length, straight);
    step.fade = all_rest ? 0 : std::max(system.common_fade(), 0.0);
    for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c)
      if (!step.rests[step.contacts.pairs[c].a])
        step.length = std::min({step.length, rim_time(step, c, step.length), away_time(step, c)});
    return;
  }
  if (!step.undisturbed) {
    step.length = std::min(step.length, tol::moment * scales.time());
    return;
  }
  Island& island = bodies_.islands.of(step.members.front());
  ++inexact_steps_;
  ConstrainedSystem::Followed followed = system.follow(step.x, step.v, step.a, island.next_length, step.length);
  step.length = followed.motion->length();
  island.next_length = followed.next;
  if (followed.stuck) check_directions(step);
  if (followed.changes) count_change(step);
  step.path = std::make_shared<Path>(Path{bodies_.now, std::move(followed.motion)});
  if (system.works()) step.forces = std::make_shared<ConstrainedSystem>(std::move(system));
}

/// The time (s) at which the pair crosses its feature's rim, on parabolas. Motion along a rim, up to rounding, does not
/// cross it.
double ConstrainedMotion::rim_time(const Step& step, std::size_t pair, double length) const {
  const World& world = bodies_.world;
  const auto& [i, e, feature] = step.contacts.names[pair];
  const std::uint32_t k = step.contacts.pairs[pair].a;
  const Vec3 w = rate(step.v, e) - step.v[k], a = acceleration(step.a, e) - step.a[k];
  RelativeMotion m{at(step.x, e) - step.x[k], w, a, w.norm(), true};
  const double speeds = step.v[k].norm() + rate(step.v, e).norm();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(w[axis]) <= tol::velocity_rounding * speeds) m.w[axis] = 0;
    if (std::abs(a[axis]) <= tol::velocity_rounding * step.greatest) m.a[axis] = 0;
  }
  const double over = tol::step_error * step.smallest / at_least_tiny(w.norm());
  const FadingPath of_i{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0}, of_e{m.d, m.w, m.a, step.fade};
  const double leaves = step.fade == 0 ? leave_feature(world, i, e, feature, m, length).time
                                       : leave_feature(world, i, of_i, e, of_e, feature, length).time;
  return std::max(leaves, over);
}

/// The time (s) at which a separating pair, or one about to separate, is so far apart that it may meet again.
double ConstrainedMotion::away_time(const Step& step, std::size_t pair) const {
  const ContactConstraint& p = step.contacts.pairs[pair];
  if (p.force > 0 || p.bilateral) return never;
  const Entity e = step.contacts.names[pair].e;
  const double u = p.normal.dot(rate(step.v, e) - step.v[p.a]), w = p.normal.dot(acceleration(step.a, e) - step.a[p.a]);
  const double far =
      4 * tol::contact_gap * std::max(bodies_.world.radius[step.contacts.names[pair].i], step.smallest);  // m
  double t = never;
  if (u > 0) t = std::min(t, far / u);
  if (w > 0) t = std::min(t, std::sqrt(2 * far / w));
  return t;
}

/// Finds what presses on each member: flat surfaces alone, on which it can rest without the group, or other things.
void ConstrainedMotion::find_unbound(Step& step) const {
  const World& world = bodies_.world;
  const std::size_t n = step.x.size();
  step.held.assign(n, 0);
  step.bound.assign(n, 0);
  step.flats.resize(n);
  step.down.assign(n, Vec3::Zero());
  for (std::size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (!(p.force > 0 || p.bilateral)) continue;
    const auto& [i, e, feature] = step.contacts.names[c];
    step.held[p.a] = 1;
    FlatContactList& flats = step.flats[p.a];
    if (p.b != ContactConstraint::fixed) {
      step.held[p.b] = step.bound[p.a] = step.bound[p.b] = 1;
    } else if (is_flat(world, i, e, feature) && !bodies_.bent[i] && flats.count < FlatContactList::most) {
      const double gap = touch(world, i, step.x[p.a] + step.down[p.a], e, at(step.x, e)).gap;
      if (gap > tol::drift * world.radius[i]) step.bound[p.a] = 1;
      step.down[p.a] += gap * p.normal;
      flats.at[flats.count++] = {e, feature, -p.normal, false, bodies_.now, 0};
    } else {
      step.bound[p.a] = 1;
    }
  }
}

/// Whether member k leaves the group after it has had time to fall back. Then nothing presses on it, or only flat
/// surfaces do.
bool ConstrainedMotion::leaves(const Step& step, std::size_t k) const {
  return !step.bound[k] && !(step.held[k] && step.rests[k]);
}

void ConstrainedMotion::note_contacts(const Step& step) {
  for (const Entity i : step.members) {
    modes_.clear_partners(i);
    group_.pressing.write(i).clear();
    group_.floors.write(i).clear();
  }
  for (std::size_t c = 0; c < step.contacts.names.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    modes_.add_partner(i, e);
    if (!(step.contacts.pairs[c].force > 0 || step.contacts.pairs[c].bilateral)) continue;
    const ContactConstraint& p = step.contacts.pairs[c];
    group_.pressing.write(i).push_back({e, p.force, p.surface});
    if (!bodies_.world.is_body(e) && is_flat(bodies_.world, i, e, feature))
      group_.floors.write(i).push_back({-p.normal, bodies_.fixed_velocity(e)});
  }
  if (!bodies_.moving.any()) return;
  // The work along a path is integrated at its end.
  for (const Entity i : step.members) step.path ? bodies_.contact_work.change(i, bodies_.now, 0) : group_.note_power(i);
}

/// Starts the members' flights until the step's end.
void ConstrainedMotion::begin_flights(const Step& step) {
  Island& island = bodies_.islands.of(step.members.front());
  island.end = island.planned = bodies_.now + step.length;
  for (const Entity i : step.members) modes_.hold(i);
  std::vector<Entity> stay;
  for (std::size_t k = 0; k < step.members.size(); ++k)
    if (begin_flight(step, k, step.members[k]))
      stay.push_back(step.members[k]);
    else if (step.forces)
      step.forces->leave_out(k);
  if (step.forces)
    bodies_.contact_work.follow(stay, bodies_.now, [path = step.path, forces = step.forces](double seconds) {
      return forces->work(*path->motion, std::min(seconds, path->motion->length()));
    });
  bodies_.islands.retain(step.members.front(), std::move(stay));
}

/// Body i, member k of the step, leaves its island, falls asleep or continues. Returns whether it stays.
bool ConstrainedMotion::begin_flight(const Step& step, std::size_t k, Entity i) {
  const Vec3 &x = step.x[k], &v = step.v[k], before = bodies_.velocity(i);
  bodies_.note_speed(i, before);
  bodies_.log.deviate(0.5 * bodies_.world.mass[i] * (before - v).dot(before + v));
  const bool was_bound = following_[i].version == bodies_.body[i].version && following_[i].bound;
  if (step.bound[k] || was_bound) group_.needed.write(i) = bodies_.now;
  if (leaves(step, k) && bodies_.now - group_.needed[i] >= step.grace) {
    modes_.leave(i);
    for (std::size_t c = 0; c < step.flats[k].count; ++c) flat_.add(i, step.flats[k].at[c]);
    flights_.begin(i, x + step.down[k], flat_.keep_at(i, v), {});
    return false;
  }
  if (step.rests[k]) {
    modes_.fall_asleep(i);
    flights_.begin(i, x, Vec3::Zero(), {});
    return false;
  }
  modes_.press(i, step.held[k] != 0);
  bodies_.islands.kicked_until.write(i) = bodies_.now;
  // A thing that it has just struck stays its origin, if nothing has changed since.
  const Flight f = bodies_.flights[i];
  const bool same = f.start == bodies_.now && x == f.x && v == before;
  flights_.go_on(i, x, v, same ? bodies_.body[i].origin() : FlightOrigin{});
  following_.write(i) = {step.path, static_cast<std::uint32_t>(k), bodies_.body[i].version, step.bound[k] != 0};
  if (step.path)
    flights_.follow(i, step.path->motion->path(k));
  else
    bodies_.flights.accelerate(i, step.a[k], step.fade);
  return true;
}

void ConstrainedMotion::report(const Island& island, double time, std::vector<ContactForce>& forces) const {
  const World& world = bodies_.world;
  const Instant now{time, 0};
  std::vector<Vec3> x, v, a;
  std::vector<double> inverse_mass;
  for (const Entity i : island.members) {
    const double t = now - bodies_.flights[i].start;
    group_.index.write(i) = static_cast<std::uint32_t>(x.size());
    x.push_back(bodies_.flights[i].position(t));
    v.push_back(bodies_.flights[i].velocity(t));
    a.push_back(bodies_.force_at(i, x.back(), v.back()));
    inverse_mass.push_back(1 / world.mass[i]);
  }
  std::vector<ContactConstraint> pairs;
  std::vector<std::pair<Entity, Entity>> names;
  for (const Entity i : island.members) {
    for (const Entity e : modes_.partners(i)) {
      // Each contact once, from its first body.
      const bool string = world.is_string(e);
      const Entity second = world.second_body(e);
      if (string ? world.string(e).body != i : second != no_entity && e < i) continue;
      if (second != no_entity && group_.index[second] == ContactConstraint::fixed) continue;
      const std::uint32_t k = group_.index[i],
                          other = second != no_entity ? group_.index[second] : ContactConstraint::fixed;
      const Vec3 xe = second != no_entity ? x[other] : bodies_.fixed_position(e, now);
      const Vec3 ve = second != no_entity ? v[other] : bodies_.fixed_velocity(e, now);
      const Touch there = touch(world, i, x[k], e, xe);
      const double bend = bending(world, i, x[k], e, xe, there, ve - v[k]);
      pairs.push_back({k, other, there.normal, -bend});
      pairs.back().bilateral = string && world.string(e).rod;
      names.emplace_back(i, e);
    }
  }
  solve({inverse_mass, a, pairs});
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (pairs[c].force > 0 || pairs[c].bilateral) forces.push_back({names[c].first, names[c].second, pairs[c].force});
  clear_index(island.members);
}

}  // namespace carom
