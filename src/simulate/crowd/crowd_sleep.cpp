// Rest is an exact solution: velocities become zero where all forces are in balance. The coarse qualities put slow
// bodies to rest instead, as their steps tremble.
#include "simulate/crowd/crowd_sleep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/tolerances.h"

namespace carom {

namespace tol = exact_tolerance;

bool CrowdSleep::wake_pressed(const Crowd& crowd) {
  std::vector<std::pair<Entity, Entity>> pressed;
  crowd.rows.for_each([&](std::size_t g, std::size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    const auto& [i, e] = crowd.rows.names[g][lane];
    if (row.b[lane] < crowd.movable() || !bodies_.world.is_body(e)) return;
    const std::uint32_t k = row.a[lane];
    const Vec3 v = crowd.velocity(k, crowd.lag[k]) + (0.5 * crowd.step.length + crowd.lag[k]) * bodies_.applied[i];
    const Vec3 normal = crowd.rows.normal(g, lane);
    const RowState& state = crowd.rows.state[g];
    if (state.gap[lane] - state.shell[lane] < crowd.step.length * normal.dot(v)) pressed.emplace_back(i, e);
  });

  for (const auto& [i, e] : pressed) {
    if (bodies_.mode(e) == Mode::asleep) group_.wake(e);
    group_.unite(i, e);
  }
  return !pressed.empty();
}

/// Whether all members press on something and hardly move. Where bodies rest by their speed: for a while.
bool CrowdSleep::is_slow(Crowd& crowd) const {
  const double unit = std::sqrt(crowd.load * crowd.smallest);  // m/s
  const double limit = (quality_.rests_by_speed ? tol::slow_preview : tol::standstill) * unit;
  bool slow = crowd.load > 0;
  for (std::size_t k = 0; slow && k < crowd.members.size(); ++k) slow = crowd.drift(k).norm() <= limit;
  for (std::size_t k = 0; slow && k < crowd.things.size(); ++k)
    slow = !bodies_.moving.any() || !bodies_.moving.moves(crowd.things[k], bodies_.now);

  if (!slow) {
    crowd.rest.slow_since = {never, 0};
    return false;
  }
  if (bodies_.now < crowd.rest.slow_since) crowd.rest.slow_since = bodies_.now;
  const double fall = std::sqrt(2 * crowd.smallest / crowd.load);  // s
  return !quality_.rests_by_speed || bodies_.now - crowd.rest.slow_since >= tol::slow_for * fall;
}

/// The forces that would hold all members, and whether they do.
CrowdSleep::Holding CrowdSleep::solve_rest(const Crowd& crowd) const {
  std::vector<Vec3> a;
  std::vector<double> inverse_mass;
  for (const Entity i : crowd.members) {
    a.push_back(bodies_.applied[i]);
    inverse_mass.push_back(1 / bodies_.world.mass[i]);
  }

  Holding holding;
  crowd.rows.for_each([&](std::size_t g, std::size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    if (crowd.rows.state[g].gap[lane] > 2 * crowd.step.shell + tol::waking_gap * crowd.smallest) return;
    const std::uint32_t b = row.b[lane] < crowd.movable() ? row.b[lane] : ContactConstraint::fixed;
    holding.pairs.push_back({row.a[lane], b, crowd.rows.normal(g, lane)});
    holding.names.push_back(crowd.rows.names[g][lane]);
  });

  bodies_.log.note(carom::solve({inverse_mass, a, holding.pairs, true}));
  holding.balanced = std::ranges::all_of(a, [&](const Vec3& left) { return left.norm() <= tol::balance * crowd.load; });
  return holding;
}

/// Wakes the sleeping bodies that these forces press on: they are in balance together, or not at all. Returns whether
/// there are some.
bool CrowdSleep::wake_beneath(const Holding& holding) {
  for (std::size_t c = 0; c < holding.pairs.size(); ++c) {
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
  if (!is_slow(crowd) || bodies_.now.hi < crowd.rest.next_try) return false;
  Holding holding = solve_rest(crowd);
  if (!holding.balanced && !quality_.rests_by_speed) {
    CrowdRest& rest = crowd.rest;
    rest.try_after = rest.try_after > 0 ? 2 * rest.try_after : 8 * crowd.step.length;
    rest.next_try = bodies_.now.hi + rest.try_after;
    return false;
  }
  if (!holding.balanced) holding = {};
  if (wake_beneath(holding)) return false;

  bodies_.log.absorb(crowd.step.kinetic);
  for (std::size_t c = 0; c < holding.pairs.size(); ++c)
    if (holding.pairs[c].force > 0)
      group_.pressing.write(holding.names[c].a).push_back({holding.names[c].e, holding.pairs[c].force});
  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    const Entity i = crowd.members[k];
    modes_.fall_asleep(i);
    flights_.begin(i, crowd.position(k), Vec3::Zero(), {});
    group_.member.write(i).gap = 2 * crowd.step.shell;
  }
  bodies_.islands.retain(crowd.members.front(), {});
  return true;
}

}  // namespace carom
