// Membership in islands: bodies join, leave and wake.
// A struck sleeper wakes with all that rest in contact with it, because their forces depend on each other.
#include "simulate/contact/exact_group.h"

#include <fmt/format.h>

#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/path/path_log.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

ExactGroup::ExactGroup(ExactBodies& bodies, ModeChanges& modes, FlatContacts& flat, const CollapseDetector& collapses,
                       PathLog& paths)
    : pressing(bodies.body.size()),
      numbers(bodies.body.size(), Numbering::none),
      member(bodies.body.size()),
      bodies_(bodies),
      modes_(modes),
      flat_(flat),
      collapses_(collapses),
      paths_(paths) {}

void ExactGroup::join(Entity i) {
  if (bodies_.mode(i) == Mode::asleep) wake(i);
  if (is_member(bodies_.mode(i))) return;
  if (!bodies_.islands.any()) bodies_.log.count_collapse();
  enlist(i);
}

/// Makes an island of body i, which is free or asleep.
void ExactGroup::enlist(Entity i) {
  paths_.note_change(i);
  modes_.join(i);
  flat_.clear(i);

  Islands& islands = bodies_.islands;
  bodies_.kick.write(i) = {bodies_.now};
  IslandMember& kept = member.write(i);
  kept.needed = bodies_.now;

  islands.create(i, bodies_.now);
}

vector<Entity> ExactGroup::coupled_with(Entity i) const {
  vector<Entity> all;
  if (!bodies_.is_coupled(i)) return all;
  vector<uint8_t> known(bodies_.body.size(), 0);
  const auto add = [&](Entity k) {
    if (exchange(known[k], 1) == 0) all.push_back(k);
  };
  add(i);
  for (size_t k = 0; k < all.size(); ++k) bodies_.couplings.for_each_link(all[k], bodies_.now.floor(), add);
  ranges::sort(all);
  return all;
}

void ExactGroup::couple(span<const Entity> all) {
  for (const Entity i : all) {
    if (bodies_.mode(i) == Mode::asleep) wake(i);
    if (!is_member(bodies_.mode(i))) enlist(i);
    unite(all.front(), i);
  }
  bodies_.islands.of(all.front()).end = bodies_.now;
}

void ExactGroup::await_step(Entity i) {
  if (bodies_.flights.curve(i) == nullptr) bodies_.flights.accelerate(i, Vec3::Zero());
  bodies_.islands.of(i).end = bodies_.now;
}

void ExactGroup::unite(Entity a, Entity b) {
  Islands& islands = bodies_.islands;
  if (!islands.same(a, b)) {
    if (bodies_.contact_work.any())
      for (const Entity i : {a, b}) bodies_.contact_work.end_paths(islands.of(i).members, bodies_.now);

    const Mode united = max(bodies_.mode(a), bodies_.mode(b));
    // An island in another mode takes that of the united one.
    for (const Entity i : {a, b}) {
      if (bodies_.mode(i) == united) continue;
      for (const Entity k : islands.of(i).members) united == Mode::held ? modes_.constrain(k) : modes_.step(k);
    }
    islands.merge(a, b, bodies_.now);
  }
}

void ExactGroup::wake(Entity i) {
  if (!bodies_.islands.any()) bodies_.log.count_collapse();
  bool crowd = false;
  vector<Entity> todo;
  const auto rouse = [&](Entity k) {
    // Constrained motion rests on its partners, or on forces between bodies alone.
    crowd = crowd || (modes_.partners(k).empty() && bodies_.touches_nothing[k] == 0);
    enlist(k);
    todo.push_back(k);
  };
  rouse(i);

  while (!todo.empty()) {
    const Entity k = todo.back();
    todo.pop_back();
    unite(i, k);

    for (const Entity e : asleep_beside(k)) rouse(e);
  }
  if (!crowd) return;
  Island& island = bodies_.islands.of(i);
  island.busy = true;
  island.calm_needed = max(island.calm_needed, exact_tolerance::calm_steps);
}

/// The sleeping bodies that touch body i, and those at the other ends of its taut strings and of its rods, each once.
/// Those that forces connect with it, too.
vector<Entity> ExactGroup::asleep_beside(Entity i) const {
  const double near = max(exact_tolerance::waking_gap * bodies_.world.radius[i], member[i].gap);  // m
  const Vec3 x = bodies_.position(i);
  vector<Entity> asleep;
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (!bodies_.world.is_body(e) || bodies_.mode(e) != Mode::asleep) continue;
    if (touch(bodies_.world, i, x, e, bodies_.position(e)).gap <= near) asleep.push_back(e);
  }

  for (const Entity string : bodies_.ties.of(i)) {
    const Entity other = bodies_.ties.other(string, i);
    if (other == no_entity || bodies_.mode(other) != Mode::asleep || ranges::count(asleep, other) > 0) continue;
    if (bodies_.world.string(string).rod || bodies_.string_now(string).gap <= near) asleep.push_back(other);
  }

  bodies_.couplings.for_each_link(i, bodies_.now.floor(), [&](Entity other) {
    if (bodies_.mode(other) == Mode::asleep && ranges::count(asleep, other) == 0) asleep.push_back(other);
  });
  return asleep;
}

void ExactGroup::join_at_rest(Entity i) {
  join(i);
  bodies_.flights.accelerate(i, Vec3::Zero());
}

void ExactGroup::join_initial(Entity first) {
  const World& world = bodies_.world;
  vector<Entity> todo{first};
  while (!todo.empty()) {
    const Entity i = todo.back();
    todo.pop_back();

    for (const Entity e : bodies_.neighbours_of(i)) {
      const Flight f = bodies_.flights[i];
      const Vec3 x = bodies_.position(i);
      const Vec3 v = bodies_.velocity(i);
      const bool body = world.is_body(e);
      const bool i_in = in_lasting_contact(bodies_.mode(i));
      const bool e_in = body && in_lasting_contact(bodies_.mode(e));
      if (flat_.carries(i, e) || (i_in && (!body || e_in))) continue;

      const Vec3 xe = bodies_.position_of(e);
      const Vec3 ve = bodies_.velocity_of(e);
      // A run may begin with the state of another one, in which contacts hold within the method's error.
      const double near =
          max(exact_tolerance::initial_rounding * (x.cwiseAbs().sum() + xe.cwiseAbs().sum() + world.radius[i]),
              bodies_.contact_gap(i, x, xe));
      if (body && (xe - x).norm() > world.radius[i] + world.radius[e] + 2 * near) continue;

      // The two must touch, without speed along the normal.
      const Touch there = touch(world, i, x, e, xe);
      if (std::abs(there.gap) > near) continue;
      const Vec3 w = ve - v;
      if (std::abs(there.normal.dot(w)) > bodies_.drift_of(i, v, ve)) continue;

      // Where neither is in an island yet, they must be pressed together.
      const double press = -(there.normal.dot(bodies_.pull_of(e) - f.acceleration(bodies_.now - f.start)) +
                             bending(world, i, x, e, xe, there, w));
      if (!i_in && !e_in && !(press > 0)) continue;

      // Both then belong to one island.
      for (const Entity k : {i, e}) {
        if (!world.is_body(k) || in_lasting_contact(bodies_.mode(k))) continue;
        join_at_rest(k);
        todo.push_back(k);
      }
      if (body) unite(i, e);
    }
  }
}

void ExactGroup::join_by_strings() {
  const World& world = bodies_.world;
  Numbering moved(numbers);  // bodies that only strings hold
  vector<Vec3> a;            // m/s^2, of these
  vector<double> inverse_mass;
  vector<ContactConstraint> rows;
  vector<Entity> strings;  // of the rows

  // Adds body i to the problem, unless it is there. Returns its number there.
  const auto place = [&](Entity i) {
    if (moved.add(i)) {
      a.push_back(bodies_.flights[i].a);
      inverse_mass.push_back(1 / world.mass[i]);
    }
    return moved.number(i);
  };

  vector<Entity> held;
  for (size_t k = 0; k < world.strings.size(); ++k) {
    const Entity string = world.string_number(k);
    const String& s = world.strings[k];
    const Touch there = bodies_.string_now(string);
    check_length(string, there.gap);
    // A run may begin with the state of another one, in which strings hold within the method's error.
    if (!bodies_.keeps_length(string, initial_rounding(string))) continue;

    const bool anchored = s.other == no_entity;
    const Vec3 w = bodies_.velocity_of(string) - bodies_.velocity(s.body);
    const Vec3 other = bodies_.position_of(string);
    // Bodies in lasting contact with other things have these accelerations.
    double known = bending(world, s.body, bodies_.position(s.body), string, other, there, w);
    const bool free = !in_lasting_contact(bodies_.mode(s.body));
    const bool other_free = !anchored && !in_lasting_contact(bodies_.mode(s.other));
    if (!free) known -= there.normal.dot(bodies_.flights[s.body].a);
    if (!anchored && !other_free) known += there.normal.dot(bodies_.flights[s.other].a);

    // A rod always holds. A taut string between ends of known acceleration holds if they would move apart.
    if (s.rod || (!free && !other_free && known < 0)) held.push_back(string);
    if (!free && !other_free) continue;

    ContactConstraint row{0, ContactConstraint::fixed, free ? there.normal : Vec3(-there.normal), -known};
    row.a = place(free ? s.body : s.other);
    if (free && other_free) row.b = place(s.other);
    row.bilateral = s.rod;
    rows.push_back(row);
    strings.push_back(string);
  }

  // Rods that contradict one another may do so by a share of the greatest acceleration.
  double greatest = 0;
  for (const Vec3& acceleration : a) greatest = max(greatest, acceleration.norm());
  for (ContactConstraint& row : rows)
    if (row.bilateral) row.slack = exact_tolerance::constrained_balance * greatest;
  solve({inverse_mass, a, rows, true});

  // Other strings hold if they are under tension.
  for (size_t k = 0; k < rows.size(); ++k)
    if (!rows[k].bilateral && rows[k].force > 0) held.push_back(strings[k]);

  // Those that hold unite their ends.
  for (const Entity string : held) {
    const String& s = world.string(string);
    join_at_rest(s.body);
    if (s.other == no_entity) continue;
    join_at_rest(s.other);
    unite(s.body, s.other);
  }
}

/// Throws SimulationError if the string is too short for its ends, or the rod not as long as they are apart.
void ExactGroup::check_length(Entity string, double gap) const {
  const String& s = bodies_.world.string(string);
  if (gap >= -initial_rounding(string) && (!s.rod || gap <= initial_rounding(string))) return;
  throw SimulationError(fmt::format("at t = 0 s the {} of ", s.rod ? "rod" : "string"), s.body,
                        fmt::format(" is {:.17g} m long, and its ends are {:.17g} m apart: change `length`, or "
                                    "place its ends accordingly",
                                    s.length, s.length - gap));
}

/// The rounding of a string's gap (m).
double ExactGroup::initial_rounding(Entity string) const {
  const String& s = bodies_.world.string(string);
  return exact_tolerance::initial_rounding *
         (bodies_.position(s.body).cwiseAbs().sum() + bodies_.position_of(string).cwiseAbs().sum() + s.length);
}

void ExactGroup::note_parted(Entity a, Entity thing, bool parted) {
  const pair pair(a, thing);
  const auto at = std::lower_bound(parted_.begin(), parted_.end(), pair);
  const bool known = at != parted_.end() && *at == pair;
  if (known && !parted) parted_.erase(at);
  if (!known && parted) parted_.insert(at, pair);
  if (parted_.size() > many_parted_) forget_apart();
}

/// Forgets pairs that are no longer in contact.
void ExactGroup::forget_apart() {
  std::erase_if(parted_, [&](const auto& pair) {
    const auto& [a, thing] = pair;
    const Vec3 x = bodies_.position(a);
    const Vec3 xe = bodies_.position_of(thing);
    return touch(bodies_.world, a, x, thing, xe).gap > bodies_.contact_gap(a, x, xe);
  });
  many_parted_ = max<size_t>(64, 2 * parted_.size());
}

bool ExactGroup::has_parted(Entity a, Entity thing) const {
  return std::binary_search(parted_.begin(), parted_.end(), pair(a, thing));
}

bool ExactGroup::strikes(Entity i, Entity e, double approach, double slow, bool apart) const {
  const World& world = bodies_.world;
  const bool body = world.is_body(e);
  const bool collapse = collapses_.ended_now(i) || (body && collapses_.ended_now(e));
  return approach >= slow && (pair_restitution(world, i, e) > 0 ? !collapse : apart);
}

double ExactGroup::pressing_force(Entity i, Entity e) const {
  for (const PressingContact& p : pressing[min(i, e)])
    if (p.partner == max(i, e)) return p.force;
  return 0;
}

vector<Entity> ExactGroup::withdraw(Entity i) {
  if (!in_lasting_contact(bodies_.mode(i))) return {};

  // What sleeps beside it may rest on it. One that wakes may wake the next.
  vector<Entity> left;
  if (bodies_.mode(i) == Mode::asleep) wake(i);
  for (const Entity e : asleep_beside(i)) {
    if (bodies_.mode(e) != Mode::asleep) continue;
    wake(e);
    left.push_back(e);
  }

  // Its island goes on without it, if it has other members.
  forget_forces(i);
  vector<Entity> stay;
  for (const Entity k : bodies_.islands.of(i).members)
    if (k != i) stay.push_back(k);
  if (!stay.empty()) left.push_back(stay.front());
  bodies_.islands.retain(i, std::move(stay));
  return left;
}

/// Nothing presses on body i any more, and it on nothing.
void ExactGroup::forget_forces(Entity i) {
  if (!pressing[i].empty()) pressing.write(i).clear();
  for (const Entity e : bodies_.neighbours_of(i))
    if (bodies_.world.is_body(e) && !pressing[e].empty())
      std::erase_if(pressing.write(e), [i](const PressingContact& contact) { return contact.partner == i; });
  for (const Entity string : bodies_.ties.of(i))
    if (const Entity other = bodies_.ties.other(string, i); other != no_entity && !pressing[other].empty())
      std::erase_if(pressing.write(other), [&](const PressingContact& contact) { return contact.partner == string; });
}

bool ExactGroup::hides(Entity i, Entity fixed) const {
  return any_of(member[i].floors, [&](const Floor& floor) {
    return bodies_.hidden(i, bodies_.position(i), fixed, floor.normal, floor.surface);
  });
}

bool ExactGroup::switches(Entity i) const {
  const auto now = [&](Entity e) { return bodies_.moving.switches(e, bodies_.now); };
  return any_of(modes_.partners(i), now) ||
         any_of(pressing[i], [&](const PressingContact& p) { return now(p.partner); });
}

/// The power of the moving things that press on body i (W).
double ExactGroup::power(Entity i) const {
  double power = 0;
  for (const PressingContact& p : pressing[i]) power -= p.force * p.surface;
  return power;
}

void ExactGroup::note_forces(Entity i) {
  vector<ContactForce> forces;
  for (const PressingContact& p : pressing[i]) forces.push_back({i, p.partner, p.force});
  bodies_.contact_work.change(i, bodies_.now, power(i), forces);
}

void ExactGroup::report(Entity i, vector<ContactForce>& forces) const {
  if (bodies_.mode(i) != Mode::asleep) return;
  for (const PressingContact& p : pressing[i]) forces.push_back({i, p.partner, p.force});
}

}  // namespace carom
