#include "simulate/event_log.h"

#include <fmt/format.h>

#include "simulate/simulation_error.h"

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

}  // namespace carom
