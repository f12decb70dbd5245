// Takes the steps of islands by constrained motion, and applies them: flights, modes and contacts until the step's end,
// and what is booked. An island with too many changes of contact in a short time is left to move as a crowd.
#include "simulate/island/constrained_motion.h"

#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

ConstrainedMotion::ConstrainedMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat,
                                     CollapseDetector& collapses, FlightChanges& flights)
    : bodies_(bodies),
      modes_(modes),
      group_(group),
      flat_(flat),
      collapses_(collapses),
      flights_(flights),
      search_(bodies, group),
      steps_(bodies, group),
      following_(bodies.body.size()) {}

/// Counts a change of the contacts of an island of this load (m/s^2) and least radius (m). Returns whether the changes
/// in a short time are not too many.
bool ConstrainedMotion::count_change(Island& island, double load, double smallest) const {
  if (load == 0 || island.changed == bodies_.now) return true;
  if (bodies_.now - island.counted > tol::time_of_changes * sqrt(2 * smallest / load)) {
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

bool ConstrainedMotion::advance(Entity i) {
  const bool undisturbed = bodies_.mode(i) == Mode::held && bodies_.now == bodies_.islands.of(i).planned;
  const bool may_be_busy = !undisturbed && !bodies_.options.merge && !bodies_.any_taut(bodies_.islands.of(i).members);
  if (!undisturbed && !bodies_.options.merge) take_in_touching(i);

  Island& island = bodies_.islands.of(i);
  ranges::sort(island.members);
  vector<uint32_t> part;
  {
    IslandStep step = begin_step(island.members, undisturbed);
    // Impacts alone end steps of bodies that forces connect, too.
    const bool changes = !step.couplings.any() || !step.contacts.pairs.empty();
    if (may_be_busy && changes && !count_change(island, step.load, step.smallest)) return false;
    part = step.parts();
    if (all_of(part, [](uint32_t first) { return first == 0; })) {
      apply(step);
      return true;
    }
  }

  // Parts that nothing connects become islands of their own.
  for (const Entity first : bodies_.islands.split(i, part)) {
    IslandStep step = begin_step(bodies_.islands.of(first).members, undisturbed);
    apply(step);
  }
  return true;
}

/// Adds bodies that touch a member without approach or separation, where nothing presses. They take part in its motion.
/// Impacts that end in contact would otherwise be resolved one after the other, down to what rounding leaves of them.
void ConstrainedMotion::take_in_touching(Entity i) {
  const World& world = bodies_.world;
  vector<Entity> todo = bodies_.islands.of(i).members;
  while (!todo.empty()) {
    const Entity k = todo.back();
    todo.pop_back();
    if (!bodies_.falls_freely(k)) continue;
    const Vec3 x = bodies_.position(k);
    const Vec3 v = bodies_.velocity(k);

    // Bodies that fall beside it, and touch it.
    for (const Entity e : bodies_.neighbours_of(k)) {
      if (!world.is_body(e) || !is_free(bodies_.mode(e))) continue;
      if (!bodies_.falls_freely(e) || bodies_.applied[e] != bodies_.applied[k]) continue;
      const Vec3 xe = bodies_.position(e);
      const Vec3 ve = bodies_.velocity(e);
      const Touch there = touch(world, k, x, e, xe);
      if (there.gap > bodies_.contact_gap(k, x, xe)) continue;
      if (std::abs(there.normal.dot(ve - v)) > tol::drift * (v.norm() + ve.norm())) continue;

      group_.join(e);
      group_.unite(i, e);
      todo.push_back(e);
    }
  }
}

/// The position (m) and velocity (m/s) of member i at present, on the path that it follows or on its flight.
pair<Vec3, Vec3> ConstrainedMotion::place_of(Entity i) const {
  const Following& following = following_[i];
  if (following.path && following.version == bodies_.body[i].version) {
    const IslandPath& path = *following.path;
    const double t = bodies_.now - path.start;
    return {path.motion->start(following.place) + path.motion->displacement(following.place, t),
            path.motion->velocity(following.place, t)};
  }

  return {bodies_.position(i), bodies_.velocity_without_kick(i, bodies_.now)};
}

/// Books member i's flight if forces on it start or end at present: those of before have acted on it.
void ConstrainedMotion::book_before_switch(Entity i) {
  const Instant& now = bodies_.now;
  if (bodies_.mode(i) == Mode::stepped || !(bodies_.flights[i].start < now)) return;
  if (bodies_.next_switch(i, std::nextafter(now.hi, -1)) != now.hi) return;

  const Vec3 x = bodies_.position(i);
  const Vec3 v = bodies_.velocity(i);
  flights_.book(i, x, now);
  bodies_.flights.set(i, {now, x, v, bodies_.flights.acceleration(i)});
}

/// The members of a step, and their contacts.
IslandStep ConstrainedMotion::begin_step(const vector<Entity>& members, bool undisturbed) {
  IslandStep step(Numbering(group_.numbers, members));
  step.at = bodies_.now;
  step.undisturbed = undisturbed;
  for (const Entity i : members) {
    const auto [x, v] = place_of(i);
    step.x.push_back(x);
    step.v.push_back(v);
    step.inverse_mass.push_back(1 / bodies_.world.mass[i]);
    step.smallest = min(step.smallest, bodies_.world.radius[i]);
    if (bodies_.forced) book_before_switch(i);
    // A crowd's forces on it may be those of others, too.
    bodies_.couplings.any() ? bodies_.apply_forces(i, x, v) : bodies_.refresh(i, x, v);
  }

  step.couplings =
      bodies_.couplings.among(members, bodies_.now.floor(), [&](Entity i) { return step.members.number(i); });
  step.applied = step.applied_at(bodies_, step.v);
  search_.find(step);
  return step;
}

/// Completes the next step of an island with connected contacts, and lets it begin.
void ConstrainedMotion::apply(IslandStep& step) {
  Island& island = bodies_.islands.of(step.members.front());
  steps_.complete(step, island.next_length);

  book(step);
  if (step.path) island.next_length = step.motion.next_length;
  if (step.motion.changes) count_change(island, step.load, step.smallest);
  note_contacts(step);
  begin_flights(step);
}

/// Books what the step's start has changed at once.
void ConstrainedMotion::book(const IslandStep& step) {
  const IslandStep::Bookings& all = step.bookings;
  for (const Certificate& certificate : all.solutions) bodies_.log.note(certificate);
  for (const Collision& collision : all.collisions) bodies_.log.record(collision);
  const AbsorbedApproaches& absorbed = all.absorbed;
  bodies_.log.take_up(step.inverse_mass, absorbed.before, absorbed.after, absorbed.pairs, absorbed.impacts);

  for (size_t c = 0; c < absorbed.names.size(); ++c)
    bodies_.contact_work.impulses.strike(step.at, absorbed.names[c].i, absorbed.names[c].e,
                                         std::abs(absorbed.pairs[c].force));
  for (const ContactForce& impulse : all.stopped)
    bodies_.contact_work.impulses.strike(step.at, impulse.a, impulse.b, impulse.force);

  for (const Entity i : all.struck) collapses_.count_in_turn(i, 1);
  if (all.work != 0) bodies_.log.add_carried_work(all.work);
  for (const Unbalanced& body : all.unbalanced) bodies_.log.note_unbalanced(body);
  if (step.motion.inexact) ++inexact_steps_;
}

/// Stores what touches and presses in the step.
void ConstrainedMotion::note_contacts(const IslandStep& step) {
  for (const Entity i : step.members) {
    modes_.clear_partners(i);
    group_.pressing.write(i).clear();
    group_.member.write(i).floors.clear();
    if (bodies_.touches_nothing[i] != 0) bodies_.touches_nothing.write(i) = 0;
  }
  if (step.couplings.any()) note_untouched(step);

  for (size_t c = 0; c < step.contacts.names.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    const ContactConstraint& p = step.contacts.pairs[c];
    modes_.add_partner(i, e);
    if (!(p.force > 0 || p.bilateral)) continue;
    group_.pressing.write(i).push_back({e, p.force, p.surface});
    if (!bodies_.world.is_body(e) && is_flat(bodies_.world, i, e, feature))
      group_.member.write(i).floors.push_back({-p.normal, e});
  }

  // What accrues along a path is integrated at its end.
  if (!bodies_.contact_work.any()) return;
  for (const Entity i : step.members)
    step.path ? bodies_.contact_work.change(i, bodies_.now, 0) : group_.note_forces(i);
}

/// Stores which members forces between bodies alone hold in the step's island.
void ConstrainedMotion::note_untouched(const IslandStep& step) {
  vector<uint8_t> touched(step.members.size(), 0);
  for (const ContactConstraint& pair : step.contacts.pairs)
    for (const uint32_t k : {pair.a, pair.b})
      if (k != ContactConstraint::fixed) touched[k] = 1;
  for (uint32_t k = 0; k < touched.size(); ++k)
    if (touched[k] == 0) bodies_.touches_nothing.write(step.members[k]) = 1;
}

/// Starts the members' flights until the step's end.
void ConstrainedMotion::begin_flights(const IslandStep& step) {
  Island& island = bodies_.islands.of(step.members.front());
  island.end = island.planned = bodies_.now + step.length;
  for (const Entity i : step.members) modes_.constrain(i);

  vector<Entity> stay;
  for (uint32_t k = 0; k < step.members.size(); ++k)
    if (begin_flight(step, k))
      stay.push_back(step.members[k]);
    else if (step.motion.forces)
      step.motion.forces->leave_out(k);

  if (step.motion.forces)
    bodies_.contact_work.follow(stay, bodies_.now, make_shared<IslandWork>(step.path, step.motion.forces));
  bodies_.islands.retain(step.members.front(), std::move(stay));
}

/// Member k of the step leaves its island, falls asleep or continues. Returns whether it stays.
bool ConstrainedMotion::begin_flight(const IslandStep& step, uint32_t k) {
  const Entity i = step.members[k];
  const Vec3& x = step.x[k];
  const Vec3& v = step.v[k];
  const Vec3 before = bodies_.velocity(i);
  const MemberFate& fate = step.fates[k];
  bodies_.note_speed(i, before);
  bodies_.log.deviate(0.5 * bodies_.world.mass[i] * (before - v).dot(before + v));

  const bool was_bound = following_[i].version == bodies_.body[i].version && following_[i].bound;
  if (fate.bound || was_bound) group_.member.write(i).needed = bodies_.now;

  // A member that nothing has needed for long enough leaves the island.
  if (fate.leaves() && bodies_.now - group_.member[i].needed >= step.grace) {
    if (bodies_.touches_nothing[i] != 0) bodies_.touches_nothing.write(i) = 0;
    modes_.leave(i);
    for (size_t c = 0; c < fate.flats.count; ++c) flat_.add(i, fate.flats.at[c]);
    flights_.begin(i, x + fate.down, flat_.keep_at(i, v), {});
    return false;
  }

  if (fate.rests) {
    modes_.fall_asleep(i);
    flights_.begin(i, x, Vec3::Zero(), {});
    if (bodies_.contact_work.any()) group_.note_forces(i);
    return false;
  }

  modes_.press(i, fate.pressed);
  // A thing that it has just struck stays its origin, if nothing has changed since.
  const Flight f = bodies_.flights[i];
  const bool same = f.start == bodies_.now && x == f.x && v == before;
  flights_.go_on(i, x, v, same ? bodies_.body[i].origin() : FlightOrigin{});

  following_.write(i) = {step.path, k, bodies_.body[i].version, fate.bound};
  if (step.path)
    flights_.follow(i, step.path->motion->path(k));
  else
    bodies_.flights.accelerate(i, step.a[k], step.fade);
  return true;
}

void ConstrainedMotion::report(const Island& island, double time, vector<ContactForce>& forces) const {
  const World& world = bodies_.world;
  IslandStep step(Numbering(group_.numbers, island.members));
  step.at = {time, 0};
  for (const Entity i : island.members) {
    const Flight f = bodies_.flights[i];
    step.x.push_back(f.position(step.at - f.start));
    step.v.push_back(f.velocity(step.at - f.start));
    step.inverse_mass.push_back(1 / world.mass[i]);
  }
  step.couplings = bodies_.couplings.among(island.members, time, [&](Entity i) { return step.members.number(i); });
  step.a = step.applied_at(bodies_, step.v);

  // Each contact once, from its first body.
  vector<ContactConstraint> pairs;
  vector<pair<Entity, Entity>> names;
  for (uint32_t k = 0; k < step.members.size(); ++k) {
    const Entity i = step.members[k];
    for (const Entity e : modes_.partners(i)) {
      const Entity second = world.second_body(e);
      const uint32_t other = step.members.number(second);
      const bool of_another = world.is_string(e) ? world.string(e).body != i : world.is_body(e) && e < i;
      if (of_another || (second != no_entity && other == Numbering::none)) continue;

      const Vec3 xe = step.position_of(bodies_, e);
      const Touch there = touch(world, i, step.x[k], e, xe);
      const double bend = bending(world, i, step.x[k], e, xe, there, step.velocity_of(bodies_, e) - step.v[k]);
      pairs.push_back({k, other, there.normal, -bend});
      if (other == Numbering::none) pairs.back().target -= there.normal.dot(bodies_.fixed_acceleration(e, step.at));
      pairs.back().bilateral = world.is_string(e) && world.string(e).rod;
      names.emplace_back(i, e);
    }
  }

  // The forces that keep them together.
  solve({step.inverse_mass, step.a, pairs, true});
  for (size_t c = 0; c < pairs.size(); ++c)
    if (pairs[c].force > 0 || pairs[c].bilateral) forces.push_back({names[c].first, names[c].second, pairs[c].force});
}

}  // namespace carom
