#include "simulate/event_log.h"

#include <fmt/format.h>

#include <algorithm>

#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"

namespace carom {

EventLog::EventLog(std::uint64_t max_collisions, bool record_collisions)
    : max_collisions_(max_collisions), record_collisions_(record_collisions) {
  if (record_collisions) collisions_.reserve(capacity);
}

void EventLog::record(const Collision& collision) {
  tally_.count(collision.kind, collision.time);
  if (record_collisions_) collisions_.push_back(collision);
  if (max_collisions_ > 0 && tally_.collisions() > max_collisions_)
    throw SimulationError(fmt::format("more than simulate.max_collisions = {} collisions, reached at t = {} s",
                                      max_collisions_, collision.time));
}

void EventLog::take_up(double approach, double energy) {
  TakenUp& all = tally_.taken_up;
  ++all.impacts;
  all.fastest = std::max(all.fastest, approach);
  all.energy += energy;
}

void EventLog::take_up(std::span<const double> inverse_mass, std::span<const Vec3> before, std::span<const Vec3> after,
                       std::span<const ContactConstraint> pairs) {
  TakenUp& all = tally_.taken_up;
  double fastest = 0;
  for (const Vec3& v : before) fastest = std::max(fastest, v.norm());
  const std::uint64_t impacts = all.impacts;
  for (const ContactConstraint& p : pairs) {
    const Vec3 vb = p.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : before[p.b];
    const double approach = p.normal.dot(before[p.a] - vb);
    if (p.force > 0 && approach > exact_tolerance::drift * fastest) take_up(approach, 0);
  }
  if (all.impacts == impacts) return;
  for (std::size_t k = 0; k < before.size(); ++k)
    all.energy += 0.5 / inverse_mass[k] * (before[k] - after[k]).dot(before[k] + after[k]);
}

}  // namespace carom
