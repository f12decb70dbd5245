// How bodies come into a crowd, take steps in it and leave it.
//
// A body that joins has no velocity of an earlier middle of a step: its first kick is half of a step. So it is with all
// members where a step is cut short. Both keep the step a leapfrog.
#include "simulate/crowd/crowd_motion.h"

#include <numeric>

#include "numerics/disjoint_sets.h"
#include "numerics/gauss.h"
#include "physics/force.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

CrowdMotion::CrowdMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlightChanges& flights)
    : bodies_(bodies),
      modes_(modes),
      group_(group),
      flights_(flights),
      quality_(*bodies.options.quality),
      threads_(bodies.options.threads),
      list_(bodies, group.numbers, threads_),
      steps_(bodies, quality_, threads_),
      sleep_(bodies, modes, group, flights, quality_, threads_) {}

bool CrowdMotion::advance(Entity i) {
  for (;;) {
    Island& island = bodies_.islands.of(i);
    for (const shared_ptr<Crowd>& crowd : island.crowds) close(*crowd, bodies_.now);
    if (bodies_.any_taut(island.members) || !island.busy) {
      for (const shared_ptr<Crowd>& crowd : island.crowds) free_flights(*crowd);
      island.crowds.clear();
      return false;
    }

    Crowd& crowd = gather(island);
    if (crowd.step.next_switch <= bodies_.now || bodies_.varying || bodies_.couplings.any()) renew_forces(crowd);
    // Nothing touches bodies that forces alone hold together.
    if (crowd.step.coupled.any() && all_of(crowd.idle, [](uint8_t steps) { return steps >= tol::idle_steps; })) {
      island.busy = false;
      continue;
    }
    crowd.step.length = longest_step(crowd);
    if (take_guests(i)) continue;
    if (!crowd.list.listed && (let_go(crowd) || list(crowd))) {
      // Members have left, and the others take the step without them.
      if (!is_member(bodies_.mode(i))) return true;
      continue;
    }
    if (bodies_.moving.any()) move_things(crowd);
    list_.measure(crowd, crowd.step.length);

    // The island may be no more if members fall asleep.
    const shared_ptr<Crowd> kept = bodies_.islands.of(i).crowds.front();
    if (sleep_.falls_asleep(*kept)) return true;
    if (!solve_step(crowd)) continue;
    if (!bodies_.islands.same(i, kept->members.front()) || bodies_.islands.of(i).crowds.size() != 1) continue;
    begin(*kept);
    count_calm(bodies_.islands.of(i), *kept);
    return true;
  }
}

void CrowdMotion::interrupt(Entity i) {
  Island& island = bodies_.islands.of(i);
  for (const shared_ptr<Crowd>& crowd : island.crowds) {
    close(*crowd, bodies_.now);
    free_flights(*crowd);
  }
  island.end = bodies_.now;
  for (const Entity k : island.members) flights_.count(k);
  flights_.note_changed(island.members.front());
}

void CrowdMotion::book_last(const Island& island, double time) const {
  for (const shared_ptr<Crowd>& crowd : island.crowds)
    if (crowd->step.open) {
      const double since = min(Instant{time, 0} - crowd->step.start, crowd->step.length);
      book(*crowd, since, since == crowd->step.length);
    }
}

/// Ends a crowd's present step at an instant. Where that is before its end, the drift becomes the velocity of then.
void CrowdMotion::close(Crowd& crowd, const Instant& at) const {
  if (!crowd.step.open) return;
  const bool full = crowd.step.end <= at;
  const double since = full ? crowd.step.length : at - crowd.step.start;
  book(crowd, since, full);
  crowd.step.open = false;
  crowd.step.last_length = full ? crowd.step.length : crowd.step.last_length;
  crowd.list.gone += since * greatest(crowd.v);

  const double age = since - 0.5 * crowd.step.length;
  for (size_t k = 0; k < crowd.members.size(); ++k) {
    add(crowd.x[k], since * crowd.drift(k));
    if (!full) add(crowd.v[k], age * crowd.a[k]);
    crowd.lag[k] = full ? age : 0;
  }
}

/// Books `since` (s) of the present step, all of it or not: the work of forces and of things that move, and what
/// contacts have taken.
void CrowdMotion::book(Crowd& crowd, double since, bool full) const {
  const double age = since - 0.5 * crowd.step.length;
  const World& world = bodies_.world;

  // Energy, less the work of forces.
  double gain = crowd.sum([&](size_t k) {
    return 0.5 * world.mass[crowd.members[k]] * crowd.velocity(k, age).squaredNorm() - work_on(crowd, k, since);
  });
  gain -= crowd.step.kinetic + book_couplings(crowd, since);
  const ptrdiff_t pressed = ranges::count(crowd.pressed, 1);
  bodies_.log.add_stepped_contact(since * double(pressed));

  // Things that move push a against the normal. Velocities of the step's ends have parts of two steps' forces.
  if (bodies_.contact_work.any())
    crowd.rows.for_each([&](size_t g, size_t lane) {
      const RowGroup& row = crowd.rows.hot[g];
      const RowState& state = crowd.rows.state[g];
      const double impulse =
          state.force[lane] * (0.5 * crowd.step.length + crowd.lag[row.a[lane]] + age) - state.carried[lane];
      const auto& [i, e] = crowd.rows.names[g][lane];
      bodies_.contact_work.impulses.spread(crowd.step.start, crowd.step.start + since, i, e, impulse);
      if (row.b[lane] < crowd.movable() || !bodies_.moving.any()) return;

      const Vec3 normal = crowd.rows.normal(g, lane);
      const double work = -impulse * normal.dot(crowd.drift(row.b[lane]));
      if (work == 0) return;
      bodies_.log.add_work(work);
      gain -= work;
    });

  // At an interruption the velocities of then become drifts, which are not ahead.
  vector<double> lent(crowd.members.size(), 0);
  for (size_t k = 0; full && k < lent.size(); ++k) lent[k] = steps_.lent(crowd, k, age);
  steps_.take(crowd, -gain, crowd.sum([&](size_t k) { return lent[k] - crowd.lent[k]; }));
  crowd.lent = std::move(lent);
}

/// Books the work of forces between members in `since` (s) of the present step. Returns it, with what their potential
/// loses (J).
double CrowdMotion::book_couplings(const Crowd& crowd, double since) const {
  if (!crowd.step.coupled.any()) return 0;
  vector<Vec3> x;
  vector<Vec3> v;
  const auto place = [&](double t) {
    x.clear();
    for (const uint32_t k : crowd.by_name) x.push_back(crowd.position(k) + t * crowd.drift(k));
  };
  for (const uint32_t k : crowd.by_name) v.push_back(crowd.drift(k));

  place(0);
  double energy = crowd.step.coupled.potential(x).sum();
  place(since);
  energy -= crowd.step.coupled.potential(x).sum();
  if (!crowd.step.coupled.works()) return energy;

  CoupledForces::Shares work;
  for (const GaussPoint& point : gauss_4) {
    place(point.at * since);
    const CoupledForces::Shares power = crowd.step.coupled.power(x, v);
    work.springs += point.weight * since * power.springs;
    work.gravitation += point.weight * since * power.gravitation;
  }
  bodies_.log.add_work(work);
  return energy + work.sum();
}

/// The work of forces on member k in `since` (s) of its drift, and what it loses of potential energy (J).
double CrowdMotion::work_on(const Crowd& crowd, size_t k, double since) const {
  const Entity i = crowd.members[k];
  const World& world = bodies_.world;
  const Vec3 moved = since * crowd.drift(k);
  if (world.forces.empty()) return world.mass[i] * world.gravity.dot(moved);
  const Vec3 x = crowd.position(k);
  return flights_.book_drift(i, {crowd.step.start, x, crowd.drift(k), Vec3::Zero()}, since) + potential(world, i, x) -
         potential(world, i, x + moved);
}

/// Lets the members of a crowd fly straight from the present instant on, without a kick in advance.
void CrowdMotion::free_flights(Crowd& crowd) const {
  if (!crowd.step.valid) return;
  crowd.step.valid = false;
  for (size_t k = 0; k < crowd.members.size(); ++k) {
    const Entity i = crowd.members[k];
    if (bodies_.mode(i) != Mode::stepped) continue;
    bodies_.flights.set(i, {bodies_.now, crowd.position(k), crowd.velocity(k, crowd.lag[k]), Vec3::Zero()});
    bodies_.kick.write(i) = {bodies_.now};
  }
}

/// The crowd of all members of an island, at present.
Crowd& CrowdMotion::gather(Island& island) {
  ranges::sort(island.members);
  if (island.crowds.size() == 1 && island.crowds[0].use_count() == 1 && island.crowds[0]->step.valid &&
      island.crowds[0]->is_of(island.members))
    return *island.crowds[0];

  const auto made = make_shared<Crowd>();
  Crowd& crowd = *made;
  crowd.members = island.members;
  const size_t n = crowd.members.size();
  crowd.by_name.resize(n);
  std::iota(crowd.by_name.begin(), crowd.by_name.end(), 0u);
  crowd.x.resize(n);
  crowd.v.resize(n);
  crowd.a.resize(n, Vec3::Zero());
  crowd.lag.resize(n, 0);
  crowd.lent.resize(n, 0);
  crowd.idle.resize(n, 0);
  crowd.pressed.resize(n, 0);
  crowd.still.resize(n, 0);

  // Members of crowds go on as they are.
  vector<uint8_t> known(n, 0);
  for (const shared_ptr<Crowd>& other : island.crowds) {
    take_over(crowd, *other, known);
    crowd.earlier.push_back(other);
    crowd.earlier.insert(crowd.earlier.end(), other->earlier.begin(), other->earlier.end());
  }

  // Others come from their flights.
  for (size_t k = 0; k < n; ++k) {
    if (known[k] < 2) add_member(crowd, k, known[k] == 0);
    crowd.smallest = min(crowd.smallest, bodies_.world.radius[crowd.members[k]]);
  }
  renew_forces(crowd);
  island.crowds = {made};
  return crowd;
}

/// Takes over what an earlier crowd has of these members. `known`, by member: 1 if it was in that crowd, and 2 if its
/// place and drift there are still its own.
void CrowdMotion::take_over(Crowd& crowd, const Crowd& earlier, vector<uint8_t>& known) const {
  const Numbering numbers(group_.numbers, crowd.members);
  size_t common = 0;
  for (size_t k = 0; k < earlier.members.size(); ++k) {
    const uint32_t number = numbers.number(earlier.members[k]);
    if (number == Numbering::none || bodies_.mode(earlier.members[k]) != Mode::stepped) continue;
    ++common;
    crowd.idle[number] = earlier.idle[k];
    crowd.pressed[number] = earlier.pressed[k];
    crowd.still[number] = earlier.still[k];
    known[number] = earlier.step.valid ? 2 : 1;

    if (!earlier.step.valid) continue;
    crowd.x[number] = earlier.x[k];
    crowd.v[number] = earlier.v[k];
    crowd.a[number] = earlier.a[k];
    crowd.lag[number] = earlier.lag[k];
    crowd.lent[number] = earlier.lent[k];
  }

  // A part that has split off must not reach farther at once than the whole: they would unite again.
  const bool part = earlier.members.size() > crowd.members.size();
  const double last = earlier.step.last_length / (part ? tol::step_growth : 1);
  crowd.step.last_length = min(crowd.step.last_length, last);
  if (part) crowd.list.most = min(crowd.list.most, earlier.list.reach);

  // Members share the balance of energy.
  const double share = double(common) / double(earlier.members.size());
  crowd.balance.taken += share * earlier.balance.taken;
  crowd.balance.made += share * earlier.balance.made;
  crowd.balance.lost += share * earlier.balance.lost;
}

/// Takes member k from its flight at present. `comes`: it was in no crowd before.
void CrowdMotion::add_member(Crowd& crowd, size_t k, bool comes) {
  const Entity i = crowd.members[k];
  const Vec3 x = bodies_.position(i);
  const Vec3 v = bodies_.velocity_without_kick(i, bodies_.now);
  crowd.x[k] = four_of(x, bodies_.world.radius[i]);
  crowd.v[k] = four_of(v, 1 / bodies_.world.mass[i]);
  if (!comes) return;
  modes_.clear_partners(i);
  if (bodies_.touches_nothing[i] != 0) bodies_.touches_nothing.write(i) = 0;
  modes_.step(i);
  bodies_.contact_work.change(i, bodies_.now, 0);
  if (!group_.pressing[i].empty()) group_.pressing.write(i).clear();
  flights_.begin(i, x, v, {});
}

/// Finds the forces on all members, the greatest of them, and when they change.
void CrowdMotion::renew_forces(Crowd& crowd) const {
  crowd.load = 0;
  crowd.step.next_switch = bodies_.moving.next_switch(bodies_.now);
  for (size_t k = 0; k < crowd.members.size(); ++k) {
    const Entity i = crowd.members[k];
    if (bodies_.forced) {
      bodies_.apply_forces(i, crowd.position(k), crowd.velocity(k, crowd.lag[k]));
      crowd.step.next_switch = min(crowd.step.next_switch, Instant{bodies_.next_switch(i, bodies_.now.floor()), 0});
    }
  }

  if (bodies_.couplings.any()) couple(crowd);
  for (const Entity i : crowd.members) crowd.load = max(crowd.load, bodies_.applied[i].norm());
}

/// Adds the forces between members, and finds how fast they change.
void CrowdMotion::couple(Crowd& crowd) const {
  vector<Entity> members;
  vector<Vec3> x;
  vector<Vec3> v;
  vector<double> inverse_mass;
  for (const uint32_t k : crowd.by_name) {
    members.push_back(crowd.members[k]);
    x.push_back(crowd.position(k));
    v.push_back(crowd.velocity(k, crowd.lag[k]));
    inverse_mass.push_back(1 / bodies_.world.mass[crowd.members[k]]);
  }

  crowd.step.coupled = bodies_.apply_couplings(members, x, v);
  crowd.step.coupling_rate = 0;
  if (!crowd.step.coupled.any()) return;
  const vector<double> exact(x.size(), 0);
  for (const CoupledForces::Scale& of : crowd.step.coupled.scales(inverse_mass, x, v, exact))
    crowd.step.coupling_rate = max(crowd.step.coupling_rate, of.rate);
}

/// The longest step that speeds and forces allow (s).
double CrowdMotion::longest_step(const Crowd& crowd) const {
  const double fastest = greatest(crowd.v);
  double length = fastest > 0 ? quality_.displacement * crowd.smallest / fastest : never;
  if (crowd.load > 0) length = min(length, quality_.longest_step * sqrt(2 * crowd.smallest / crowd.load));
  if (bodies_.varying)
    for (size_t k = 0; k < crowd.members.size(); ++k)
      if (const Entity i = crowd.members[k]; bodies_.bent[i]) {
        const double rate = force_rate(bodies_.world, i, crowd.position(k), crowd.drift(k));
        if (rate > 0) length = min(length, quality_.longest_step / rate);
      }
  if (crowd.step.coupling_rate > 0) length = min(length, quality_.longest_step / crowd.step.coupling_rate);

  // Things that swing turn and speed up as forces do.
  if (bodies_.moving.any())
    for (const Entity e : crowd.things)
      if (const Swing* swing = bodies_.world.swing(e))
        length = min({length, quality_.longest_step / turning_rate(*swing),
                      quality_.longest_step * sqrt(2 * crowd.smallest / greatest_acceleration(*swing))});
  length = min(length, tol::step_growth * crowd.step.last_length);
  return min(length, crowd.step.next_switch - bodies_.now);
}

/// Lets bodies join that a member may meet before the list is made anew. Returns whether there are some.
bool CrowdMotion::take_guests(Entity i) {
  const shared_ptr<Crowd> crowd = bodies_.islands.of(i).crowds.front();
  CrowdReach& list = crowd->list;
  vector<Entity> near = exchange(bodies_.islands.of(i).watched, {});
  const double length = crowd->step.length;
  const double need = max(list.need, length * (greatest(crowd->v) + 0.5 * length * crowd->load));

  // Beyond its reach the list is made anew.
  const bool anew = !(list.gone + need <= list.reach);
  if (anew) {
    list_.begin(*crowd, need);
    list.outsiders = list_.hold_regions(*crowd, bodies_.islands.of(i).members);
    near.clear();
  }
  list.outsiders.insert(list.outsiders.end(), near.begin(), near.end());
  if (anew || list.sure < bodies_.now + length) {
    list.sure = bodies_.now + tol::steps_of_list * length;
    near = list.outsiders;
  } else {
    near.insert(near.end(), list.coming.begin(), list.coming.end());
  }
  list.coming.clear();

  // Those that join bring others.
  bool any = false;
  for (;;) {
    const vector<Entity> guests = choose_guests(*crowd, near);
    if (guests.empty()) break;
    any = true;
    near = list_.hold_regions(*crowd, unite(i, guests));
    list.outsiders.insert(list.outsiders.end(), near.begin(), near.end());
  }
  if (any) go_on_with(i, *crowd);
  return any;
}

/// Lets these bodies join the island of member i. Returns all that are new in it.
vector<Entity> CrowdMotion::unite(Entity i, span<const Entity> guests) {
  vector<Entity> came;
  for (const Entity e : guests) {
    group_.join(e);
    if (bodies_.islands.same(i, e)) continue;
    const vector<Entity>& members = bodies_.islands.of(e).members;
    came.insert(came.end(), members.begin(), members.end());
    group_.unite(i, e);
  }
  return came;
}

/// Gathers the crowd of member i, whose regions are those of the list of an earlier crowd.
void CrowdMotion::go_on_with(Entity i, Crowd& earlier) {
  Island& island = bodies_.islands.of(i);
  for (const shared_ptr<Crowd>& crowd : island.crowds) close(*crowd, bodies_.now);
  Crowd& crowd = gather(island);
  crowd.list = std::move(earlier.list);
  crowd.list.listed = false;
}

/// Of these outsiders, those that are to join. Others that come nearer are looked at again.
vector<Entity> CrowdMotion::choose_guests(Crowd& crowd, span<const Entity> near) {
  vector<Entity> guests;
  for (const Entity e : near) {
    const Mode mode = bodies_.mode(e);
    if (!is_in_world(mode) || mode == Mode::asleep) continue;
    if (is_member(mode) && bodies_.islands.same(e, crowd.members.front())) continue;

    const CrowdList::Outlook outlook = list_.outlook(crowd, e);
    if (outlook == CrowdList::Outlook::joins) guests.push_back(e);
    if (outlook == CrowdList::Outlook::may_strike) flights_.note_changed(e);
    if (outlook == CrowdList::Outlook::may_strike || outlook == CrowdList::Outlook::may_come)
      crowd.list.coming.push_back(e);
  }
  ranges::sort(guests);
  return guests;
}

/// Lists the pairs that may press. Returns whether the island has split.
bool CrowdMotion::list(Crowd& crowd) {
  crowd.earlier.push_back(bodies_.islands.of(crowd.members.front()).crowds.front());
  list_.list(crowd, crowd.earlier);
  crowd.earlier.clear();
  return split(crowd);
}

/// Lets members fly that nothing has pressed on for a while, and that are so far from the others that they would not
/// join again. Returns whether there are some.
bool CrowdMotion::let_go(Crowd& crowd) {
  const auto is_near = [&](size_t k) {
    const Entity i = crowd.members[k];
    const Vec3 x = crowd.position(k);
    return any_of(bodies_.neighbours.bodies(i), [&](Entity e) {
      const double sizes = bodies_.world.radius[i] + bodies_.world.radius[e];
      return (bodies_.position(e) - x).norm() < sizes + crowd.list.room - crowd.list.gone &&
             is_member(bodies_.mode(e)) && bodies_.islands.same(i, e);
    });
  };

  // Those that nothing holds fly on alone.
  vector<Entity> stay;
  for (const uint32_t k : crowd.by_name) {
    const Entity i = crowd.members[k];
    if (crowd.idle[k] < tol::idle_steps || bodies_.is_coupled(i) || is_near(k)) {
      stay.push_back(i);
      continue;
    }
    modes_.leave(i);
    flights_.begin(i, crowd.position(k), crowd.velocity(k, crowd.lag[k]), {});
  }
  if (stay.size() == crowd.members.size()) return false;

  // The island may be no more, and its crowd with it.
  const shared_ptr<Crowd> whole = bodies_.islands.of(crowd.members.front()).crowds.front();
  const Entity first = stay.empty() ? no_entity : stay.front();
  bodies_.islands.of(crowd.members.front()).end = bodies_.now;
  bodies_.islands.retain(crowd.members.front(), std::move(stay));
  if (first == no_entity) return true;
  flights_.note_changed(first);
  go_on_with(first, *whole);
  return true;
}

/// Splits off parts that no near pairs connect, and in which contacts press. They become islands of their own. Returns
/// whether there are some.
bool CrowdMotion::split(Crowd& crowd) {
  const size_t n = crowd.members.size();
  DisjointSets sets(n);
  crowd.rows.for_each([&](size_t g, size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    if (row.b[lane] < crowd.movable()) sets.join(row.a[lane], row.b[lane]);
  });

  // Forces connect members, too.
  crowd.step.coupled.for_each_link([&](uint32_t a, uint32_t b) { sets.join(crowd.by_name[a], crowd.by_name[b]); });

  // Parts with contacts or such forces, each by its first member. All others stay with the first of them.
  vector<uint8_t> presses(n, 0);
  crowd.step.coupled.for_each_link([&](uint32_t a, uint32_t) { presses[sets.root(crowd.by_name[a])] = 1; });
  for (uint32_t k = 0; k < n; ++k)
    if (crowd.pressed[k] != 0) presses[sets.root(k)] = 1;
  vector<uint32_t> first(n, ContactConstraint::fixed);
  vector<uint32_t> label(n);
  uint32_t rest = ContactConstraint::fixed;
  size_t parts = 0;

  // Each member gets the label of its part.
  for (uint32_t k = 0; k < n; ++k) {
    const size_t root = sets.root(crowd.by_name[k]);
    uint32_t& of_part = presses[root] != 0 ? first[root] : rest;
    if (of_part == ContactConstraint::fixed) {
      of_part = k;
      ++parts;
    }
    label[k] = of_part;
  }
  if (parts < 2) return false;

  const shared_ptr<Crowd> whole = bodies_.islands.of(crowd.members.front()).crowds.front();
  bodies_.islands.of(crowd.members.front()).end = bodies_.now;
  // Each part has a crowd of its own from here on, so that no member is in two.
  for (const Entity i : bodies_.islands.split(crowd.members.front(), label)) {
    Crowd& part = gather(bodies_.islands.of(i));
    part.list = whole->list;
    part.list.most = whole->list.reach;
    part.earlier.clear();
    list_.list_part(part);
    flights_.note_changed(i);
  }
  return true;
}

/// Moves the things that move to their present places. Those that swing drift to where they are at the step's end.
void CrowdMotion::move_things(Crowd& crowd) const {
  for (size_t k = 0; k < crowd.things.size(); ++k) {
    if (!bodies_.world.moves(crowd.things[k])) continue;
    crowd.x[crowd.members.size() + k] = four_of(bodies_.fixed_position(crowd.things[k]), 0);
    crowd.v[crowd.members.size() + k] = four_of(bodies_.fixed_velocity(crowd.things[k]), 0);
  }
  steps_.drift_things(crowd);
}

/// Solves the step. False: other bodies take part, or it needs a longer list.
bool CrowdMotion::solve_step(Crowd& crowd) {
  if (steps_.solve(crowd)) return true;
  sleep_.wake_pressed(crowd);
  return false;
}

/// Lets the step begin, with flights of members until its end.
void CrowdMotion::begin(Crowd& crowd) {
  steps_.finish(crowd);
  crowd.step.start = bodies_.now;
  crowd.step.end = bodies_.now + crowd.step.length;
  // Rounding must not leave a step of nothing before a switch.
  if (crowd.step.next_switch.hi <= crowd.step.end.hi) crowd.step.end = crowd.step.next_switch;
  crowd.step.open = true;
  bodies_.islands.of(crowd.members.front()).end = crowd.step.end;
  flights_.note_changed(crowd.members.front());

  const Instant middle = bodies_.now + 0.5 * crowd.step.length;
  for (const uint32_t k : crowd.by_name) {
    const Entity i = crowd.members[k];
    modes_.press(i, crowd.pressed[k] != 0);
    bodies_.note_speed(i, crowd.drift(k));
    bodies_.flights.set(i, {crowd.step.start, crowd.position(k), crowd.drift(k), Vec3::Zero()});
    bodies_.kick.write(i) = {middle, crowd.a[k]};
  }
}

void CrowdMotion::report(const Island& island, vector<ContactForce>& forces) {
  for (const shared_ptr<Crowd>& crowd : island.crowds)
    crowd->rows.for_each([&](size_t g, size_t lane) {
      const auto& [i, e] = crowd->rows.names[g][lane];
      const double force = crowd->rows.state[g].force[lane];
      if (force > 0) forces.push_back({i, e, force});
    });
}

/// Counts steps in which the same pairs press. After some of them the shells close, and constrained motion follows.
void CrowdMotion::count_calm(Island& island, Crowd& crowd) {
  uint64_t hash = 0;
  double widest = 0;
  size_t pressing = 0;
  crowd.rows.for_each([&](size_t g, size_t lane) {
    if (!(crowd.rows.state[g].force[lane] > 0)) return;
    const auto& [i, e] = crowd.rows.names[g][lane];
    hash += (uint64_t{i} << 32 | e) * 0x9e3779b97f4a7c15u;
    widest = max(widest, crowd.rows.state[g].shell[lane]);
    ++pressing;
  });

  island.calm = hash == island.pressing ? island.calm + 1 : 0;
  island.pressing = hash;
  crowd.rest.closing = island.calm >= max<size_t>(island.calm_needed, pressing);
  if (!crowd.rest.closing) return;

  // Shells close bit by bit, so that bodies do not fall.
  if (widest <= tol::closed_shell * crowd.smallest) {
    island.busy = false;
    island.calm = 0;
    return;
  }
  for (RowState& state : crowd.rows.state)
    for (double& shell : state.shell) shell *= tol::shell_decay;
}

}  // namespace carom
