// The record of a run: collisions in a buffer, and running sums of energy, work and extremes.
// The energy of impacts that contact absorbs is that of the velocities before and after a solution.
#include "simulate/event_log.h"

#include <fmt/format.h>

#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

EventLog::EventLog(uint64_t max_collisions, bool record_collisions, size_t forces, bool coupled,
                   span<const Trigger> triggers)
    : max_collisions_(max_collisions),
      record_collisions_(record_collisions),
      triggers_(triggers),
      force_work_(forces + (coupled ? 2 : 0)) {
  tally_.force_work.resize(force_work_.size());
  tally_.changes.fired.assign(triggers.size(), not_yet);
  if (record_collisions) collisions_.reserve(capacity);
}

void EventLog::record(const Collision& collision) {
  tally_.count(collision.kind, collision.time);
  if (collision.kind == CollisionKind::rest) add_absorbed(-collision.energy_lost);
  if (record_collisions_) collisions_.push_back(collision);
  if (!triggers_.empty()) [[unlikely]]
    note_event(collision);
  if (max_collisions_ > 0 && tally_.collisions() > max_collisions_)
    throw SimulationError(fmt::format("more than simulate.max_collisions = {} collisions, reached at t = {} s",
                                      max_collisions_, collision.time));
}

uint32_t EventLog::take_noted(double time) {
  const uint32_t trigger = noted_.back();
  noted_.pop_back();
  tally_.changes.fired[trigger] = time;
  return trigger;
}

void EventLog::pass(Passage& passage, Sum& sum, double energy, const Vec3& momentum) {
  ++passage.bodies;
  sum.add(energy);
  passage.energy = sum.value();
  passage.momentum += momentum;
}

void EventLog::note(const SharedImpacts& now) {
  SharedImpacts& all = tally_.shared;
  const SharedImpacts before = all;
  if (before.instants == 0 && now.instants > 0) all = now;
  all.instants = before.instants + now.instants;
  all.ties = before.ties + now.ties;
  all.without_room = before.without_room + now.without_room;
  all.absorbed = before.absorbed + now.absorbed;
}

void EventLog::take_up(double approach, double energy) {
  TakenUp& all = tally_.taken_up;
  ++all.impacts;
  all.fastest = max(all.fastest, approach);
  add_absorbed(energy);
}

void EventLog::take_up(span<const double> inverse_mass, span<const Vec3> before, span<const Vec3> after,
                       span<const ContactConstraint> pairs, span<const AbsorbedImpact> impacts) {
  double fastest = 0;
  for (const Vec3& v : before) fastest = max(fastest, v.norm());

  // Recorded impacts have their own energy.
  bool any = false;
  bool any_recorded = false;
  double of_recorded = 0;  // J
  double work = 0;         // J
  for (size_t c = 0; c < pairs.size(); ++c) {
    const ContactConstraint& p = pairs[c];
    if (!(p.force > 0 || (p.bilateral && p.force < 0))) continue;
    work += p.work();

    const double met = p.bilateral ? std::abs(approach(before, p)) : approach(before, p);
    const double speed = impacts.empty() ? met : impacts[c].approach;
    if (!impacts.empty() && impacts[c].recorded) {
      of_recorded += impacts[c].lost;
      any_recorded = true;
    } else if (speed > max(exact_tolerance::drift * fastest, p.slack)) {
      take_up(speed, 0);
      any = true;
    }
  }

  if (work != 0) add_carried_work(work);
  if (!any && !any_recorded) return;

  // The energy lost: the work of moving things, and what the motion loses.
  double lost = work;  // J
  for (size_t k = 0; k < before.size(); ++k)
    lost += 0.5 / inverse_mass[k] * (before[k] - after[k]).dot(before[k] + after[k]);
  lose(lost);
  deviate(-lost);
  add_absorbed(lost - of_recorded);
}

}  // namespace carom
