// Where there are more bodies than a processor's own memory holds, an event waits for memory a dozen times on end, each
// time for what tells where to look next. What is due soon is asked for ahead of its time, step by step.
#include <algorithm>

#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr std::size_t far_ahead = 32;  // events
constexpr std::size_t steps = 2;       // events from one step to the next

}  // namespace

/// Changes nothing.
void ExactSimulator::look_ahead() {
  const double now = queue_.first_time();
  while (next_due_ < due_.size() && due_[next_due_].time <= now) ++next_due_;
  // Asked again after many events only: where few are due at all, that many are never found.
  if (due_events_ >= far_ahead / 2 && next_due_ + far_ahead / 2 >= due_.size()) {
    // As far as so many events took before, or farther.
    if (!due_.empty())
      due_reach_ = (now - due_from_) * static_cast<double>(far_ahead) / static_cast<double>(due_events_);
    due_from_ = now;
    due_events_ = 0;
    next_due_ = 0;
    for (int attempt = 0; attempt < 8; ++attempt) {
      due_.clear();
      queue_.due_until(now + due_reach_, due_);
      if (due_.size() >= far_ahead) break;
      due_reach_ = 2 * due_reach_ + 0x1p-40 * now;
    }
    if (due_.size() > 4 * far_ahead) {
      std::nth_element(due_.begin(), due_.begin() + 4 * far_ahead, due_.end(),
                       [](const auto& p, const auto& q) { return p.time < q.time; });
      due_.resize(4 * far_ahead);
    }
    std::sort(due_.begin(), due_.end(), [](const auto& p, const auto& q) { return p.time < q.time; });
  }
  ++due_events_;
  const auto at = [&](std::size_t step) {
    const std::size_t k = next_due_ + step * steps;
    return k < due_.size() ? due_[k].entry : no_entity;
  };
  const auto partner = [&](Entity i) {
    const Event& event = body_[i].event;
    return event.kind == Kind::body_body && !leaves_first(i) ? event.partner : i;
  };
  const auto prefetch_body = [&](Entity i) {
    prefetch(&body_[i]);
    prefetch(flight_.cores() + i);
    neighbours_.prefetch_known(i);
    neighbours_.prefetch_region(i);
    queue_.prefetch(i);
    prefetch(&world_.radius[i]);
    prefetch(&world_.mass[i]);
    prefetch(&world_.restitution[i]);
  };
  const auto prefetch_flights = [&](Entity i) {
    for (const Entity j : neighbours_.bodies(i)) {
      prefetch(flight_.cores() + j);
      if (!same_radius_) prefetch(&world_.radius[j]);
      prefetch(&body_[j]);
    }
  };
  if (const Entity i = at(4); i != no_entity) prefetch_body(i);
  if (const Entity i = at(3); i != no_entity) {
    neighbours_.prefetch_list(i);
    prefetch_body(partner(i));
  }
  if (const Entity i = at(2); i != no_entity) {
    if (leaves_first(i)) {
      for (const Entity k : neighbours_.bodies(i)) {
        neighbours_.prefetch_region(k);
        neighbours_.prefetch_known(k);
      }
    } else {
      prefetch_flights(i);
      neighbours_.prefetch_list(partner(i));
    }
  }
  if (const Entity i = at(1); i != no_entity && partner(i) != i) prefetch_flights(partner(i));
}

}  // namespace carom
