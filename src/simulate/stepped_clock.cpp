#include "simulate/stepped_clock.h"

#include <fmt/format.h>

#include <algorithm>

#include "physics/whole.h"
#include "simulate/simulation_error.h"

namespace carom {

StepClock::StepClock(const World& world, double duration, double step) : duration_(duration), step_(step) {
  for (const Force& force : world.forces)
    for (const double t : {force.from, force.until})
      if (t > 0 && t < duration) switches_.push_back(t);
  std::sort(switches_.begin(), switches_.end());
}

void StepClock::advance() {
  from_ = to_;
  to_ = next_time();
  length_ = to_ - from_;
}

bool StepClock::forces_change() const {
  return std::binary_search(switches_.begin(), switches_.end(), from_);
}

/// s, where a step from from_ ends.
double StepClock::next_time() {
  if (!(from_ + step_ > from_))
    throw SimulationError(
        fmt::format("at t = {} s steps of {} s no longer move the clock: use a longer simulate.step", from_, step_));
  steps_ = std::max(steps_, static_cast<std::uint64_t>(whole_below(from_ / step_)));
  while (static_cast<double>(steps_) * step_ <= from_) ++steps_;
  double next = std::min(static_cast<double>(steps_) * step_, duration_);
  const auto at = std::upper_bound(switches_.begin(), switches_.end(), from_);
  if (at != switches_.end()) next = std::min(next, *at);
  return next;
}

}  // namespace carom
