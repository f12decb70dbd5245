// Rest is an exact solution: velocities become zero where all forces are in balance. The coarse qualities put slow
// bodies to rest instead, as their steps tremble.
#include "simulate/crowd/crowd_sleep.h"

#include "geometry/shell.h"
#include "numerics/disjoint_sets.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"
#include "solver/least_forces.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

void CrowdSleep::wake_pressed(Crowd& crowd) {
  vector<RowName> pressed = exchange(crowd.struck, {});
  crowd.rows.for_each([&](size_t g, size_t lane) {
    if (crowd.presses_on_sleeper(g, lane, bodies_.world)) pressed.push_back(crowd.rows.names[g][lane]);
  });

  for (const auto& [i, e] : pressed) {
    if (bodies_.mode(e) == Mode::asleep) group_.wake(e);
    group_.unite(i, e);
  }
}

/// By member: whether it is to rest. All are if all hardly move. A part of a crowd must have done so for a while, with
/// all that press on one another in it: what moves may be about to press on it.
vector<uint8_t> CrowdSleep::slow_members(Crowd& crowd) const {
  const double limit = tol::standstill * sqrt(crowd.load * crowd.smallest);  // m/s
  const auto moves = [&](size_t k) { return !(crowd.load > 0) || crowd.drift(k).norm() > limit; };
  const auto count = uint32_t(crowd.members.size());
  bool all = true;
  for (uint32_t k = 0; all && k < count; ++k) all = !moves(k);
  vector<uint8_t> rests(count, all ? 1 : 0);
  if (all || ++crowd.rest.steps % tol::steps_to_look != 0) return rests;

  DisjointSets parts(count);
  crowd.rows.for_each([&](size_t g, size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    if (crowd.rows.state[g].force[lane] > 0 && row.b[lane] < crowd.movable()) parts.join(row.a[lane], row.b[lane]);
  });

  vector<uint8_t> moving(count, 0);  // by part
  for (uint32_t k = 0; k < count; ++k)
    if (moves(k)) moving[parts.root(k)] = 1;
  for (uint32_t k = 0; k < count; ++k) {
    crowd.still[k] = moving[parts.root(k)] != 0 ? 0 : uint8_t(min(crowd.still[k] + 1, 255));
    rests[k] = crowd.still[k] >= tol::still_looks ? 1 : 0;
  }

  // The few that rest among others that move would wake soon.
  if (2 * ranges::count(rests, 1) < ptrdiff_t(count)) ranges::fill(rests, 0);
  return rests;
}

/// Whether the crowd has been slow as a whole for a while, and something has pressed on each of its members.
bool CrowdSleep::has_settled(Crowd& crowd) const {
  const double limit = tol::slow_preview * sqrt(crowd.load * crowd.smallest);  // m/s
  const double squares = crowd.sum([&](size_t k) { return crowd.drift(k).squaredNorm(); });
  const bool carried = crowd.load > 0 && all_of(crowd.idle, [](uint8_t steps) { return steps <= tol::idle_steps; });

  if (!carried || squares > limit * limit * double(crowd.members.size())) {
    crowd.rest.slow_since = {never, 0};
    return false;
  }
  if (bodies_.now < crowd.rest.slow_since) crowd.rest.slow_since = bodies_.now;
  return bodies_.now - crowd.rest.slow_since >= tol::slow_for * sqrt(2 * crowd.smallest / crowd.load);
}

/// The pairs that touch, of the members that are to rest, with their present forces (N).
CrowdSleep::Holding CrowdSleep::touching(const Crowd& crowd, span<const uint8_t> rests) const {
  Holding holding;
  holding.number.resize(crowd.members.size(), ContactConstraint::fixed);
  for (const uint32_t k : crowd.by_name)
    if (rests[k] != 0) {
      holding.number[k] = uint32_t(holding.members.size());
      holding.members.push_back(k);
    }

  // Their pairs that touch.
  crowd.rows.for_each([&](size_t g, size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    const bool body = row.b[lane] < crowd.movable();
    if (rests[row.a[lane]] == 0 || (body && rests[row.b[lane]] == 0)) return;
    if (crowd.rows.state[g].gap[lane] > 2 * crowd.step.shell + tol::waking_gap * crowd.smallest) return;
    const uint32_t b = body ? holding.number[row.b[lane]] : ContactConstraint::fixed;
    holding.pairs.push_back({holding.number[row.a[lane]], b, crowd.rows.normal(g, lane)});
    holding.pairs.back().force = crowd.rows.state[g].force[lane];
    holding.rows.push_back({g, lane});
    holding.names.push_back(crowd.rows.names[g][lane]);
  });
  return holding;
}

/// Finds the forces that would hold them. Returns whether they do.
bool CrowdSleep::solve_rest(const Crowd& crowd, Holding& holding) {
  vector<Vec3> motion;  // m/s^2
  vector<double> inverse_mass;
  for (const uint32_t k : holding.members) {
    motion.push_back(bodies_.applied[crowd.members[k]]);
    inverse_mass.push_back(1 / bodies_.world.mass[crowd.members[k]]);
  }

  const ContactProblem problem{inverse_mass, motion, holding.pairs, true};
  if (holding.members.size() <= tol::exact_members || !hold_by_sweeps(crowd, holding, problem))
    bodies_.log.note(carom::solve(problem));
  const double unsure = max(tol::balance, unsure_direction(crowd, holding)) * crowd.load;
  return all_of(motion, [&](const Vec3& left) { return left.norm() <= unsure; });
}

/// The angle by which a shell's normal at a contact is unsure, because contacts keep gaps. A heap in a bowl is in
/// balance at one place alone. It need not be nearer to that than places are sure.
double CrowdSleep::unsure_direction(const Crowd& crowd, const Holding& holding) const {
  const World& world = bodies_.world;
  double angle = 0;
  for (const auto& [i, e] : holding.names)
    if (world.is_shell(e))
      angle = max(angle, crowd.step.shell / Shell(world.obstacle(e)).bend_radius(world.radius[i], shell_inner));
  return angle;
}

/// The same by sweeps from the present forces, as in a step of 1 s from rest, and a last correction. In a large heap
/// that takes a thirtieth of the contact solver's time. Where forces are not unique, they are near the present ones.
/// The problem's motion becomes what is left. False, and it stays: the sweeps do not end.
bool CrowdSleep::hold_by_sweeps(const Crowd& crowd, Holding& holding, const ContactProblem& problem) {
  vector<Four> v(crowd.v.size());
  for (size_t m = 0; m < holding.members.size(); ++m)
    v[holding.members[m]] = four_of(problem.motion[m], problem.inverse_mass[m]);

  // Only the pairs that touch.
  CrowdRows rows = crowd.rows;
  for (size_t g = 0; g < rows.groups(); ++g) {
    ranges::fill(rows.hot[g].base, never);
    ranges::fill(rows.hot[g].impulse, 0.0);
    ranges::fill(rows.change[g].slack, never);
  }
  for (size_t c = 0; c < holding.pairs.size(); ++c) {
    const auto& [g, lane] = holding.rows[c];
    rows.hot[g].base[lane] = 0;
    rows.hot[g].impulse[lane] = holding.pairs[c].force;
  }
  kernels_.push(rows.hot.data(), rows.groups(), v.data());

  const double left = 0.1 * tol::balance * crowd.load;  // m/s^2, of a body by a sweep
  const double goal = left * left * double(holding.members.size());
  if (solver_.balance(rows, v, {1, goal, crowd.load, tol::sweeps_to_rest}).change > goal) return false;

  // Bodies would move, or rounding is left.
  for (size_t c = 0; c < holding.pairs.size(); ++c)
    holding.pairs[c].force = rows.hot[holding.rows[c].group].impulse[holding.rows[c].lane];
  const auto moves = [&](uint32_t k) { return vector_of(v[k]).norm() > tol::nearly_balanced * crowd.load; };
  if (any_of(holding.members, moves))
    for (size_t m = 0; m < holding.members.size(); ++m) problem.motion[m] = vector_of(v[holding.members[m]]);
  else
    correct_hold(problem);
  return true;
}

/// Wakes the sleeping bodies that these forces press on: they are in balance together, or not at all. Returns whether
/// there are some.
bool CrowdSleep::wake_beneath(const Holding& holding) {
  for (size_t c = 0; c < holding.pairs.size(); ++c) {
    const auto& [i, e] = holding.names[c];
    const ContactConstraint& pair = holding.pairs[c];
    if (!(pair.force > 0) || pair.b != ContactConstraint::fixed || !bodies_.world.is_body(e)) continue;
    if (bodies_.mode(e) == Mode::asleep) group_.wake(e);
    group_.unite(i, e);
    return true;
  }
  return false;
}

bool CrowdSleep::falls_asleep(Crowd& crowd) {
  if (bodies_.now.hi < crowd.rest.next_try) return false;
  for (const Entity thing : crowd.things)
    if (bodies_.moving.any() && bodies_.moving.moves(thing, bodies_.now)) return false;

  vector<uint8_t> rests(crowd.members.size(), 1);
  if (!quality_.rests_by_speed) rests = slow_members(crowd);
  if (quality_.rests_by_speed ? !has_settled(crowd) : none_of(rests, std::identity())) return false;
  // Those that forces connect rest together.
  if (crowd.step.coupled.any()) {
    if (!all_of(rests, std::identity())) return false;
    apply_at_rest(crowd);
  }

  Holding holding = touching(crowd, rests);
  if (!quality_.rests_by_speed && !solve_rest(crowd, holding)) {
    CrowdRest& rest = crowd.rest;
    rest.try_after = rest.try_after > 0 ? 2 * rest.try_after : 8 * crowd.step.length;
    rest.next_try = bodies_.now.hi + rest.try_after;
    return false;
  }
  if (wake_beneath(holding)) return false;
  put_to_rest(crowd, holding);
  return true;
}

/// Sets the forces on members to those at rest, without dampers. The next step sets them anew.
void CrowdSleep::apply_at_rest(const Crowd& crowd) {
  vector<Entity> members;
  vector<Vec3> x;
  for (const uint32_t k : crowd.by_name) {
    const Entity i = crowd.members[k];
    members.push_back(i);
    x.push_back(crowd.position(k));
    bodies_.apply_forces(i, x.back(), Vec3::Zero());
  }
  bodies_.apply_couplings(members, x, vector<Vec3>(x.size(), Vec3::Zero()));
}

/// Lets them sleep. Other members take the step without them.
void CrowdSleep::put_to_rest(Crowd& crowd, const Holding& holding) {
  for (size_t c = 0; c < holding.pairs.size(); ++c)
    if (holding.pairs[c].force > 0)
      group_.pressing.write(holding.names[c].a).push_back({holding.names[c].e, holding.pairs[c].force});

  double kinetic = 0;  // J
  for (const uint32_t k : holding.members) {
    const Entity i = crowd.members[k];
    kinetic += 0.5 * bodies_.world.mass[i] * crowd.velocity(k, crowd.lag[k]).squaredNorm();
    modes_.fall_asleep(i);
    flights_.begin(i, crowd.position(k), Vec3::Zero(), {});
    group_.member.write(i).gap = 2 * crowd.step.shell;
    if (bodies_.contact_work.any()) group_.note_forces(i);
  }
  bodies_.log.absorb(kinetic);

  vector<Entity> stay;
  for (const uint32_t k : crowd.by_name)
    if (holding.number[k] == ContactConstraint::fixed) stay.push_back(crowd.members[k]);
  bodies_.islands.of(crowd.members.front()).end = bodies_.now;
  if (!stay.empty()) flights_.note_changed(stay.front());
  bodies_.islands.retain(crowd.members.front(), std::move(stay));
}

}  // namespace carom
