#pragma once
// The steps of the stepped simulator in time. A step ends at a multiple of the given step, where a force sets in or
// ceases, or at the end. Multiples are computed, not summed up, so that a long run loses no digits.
#include <cstdint>
#include <vector>

#include "physics/world.h"

namespace carom {

class StepClock {
 public:
  /// duration: s, where the last step ends. step: s.
  StepClock(const World& world, double duration, double step);

  /// Goes on to the next step. Throws SimulationError where a step no longer moves the clock.
  void advance();

  double from() const { return from_; }      // s, where the present step begins; 0 before the first,
  double to() const { return to_; }          // s, and ends
  double length() const { return length_; }  // s
  double duration() const { return duration_; }
  /// Whether a force sets in or ceases where the present step begins.
  bool forces_change() const;

 private:
  double next_time();

  const double duration_, step_;  // s
  std::vector<double> switches_;  // s, ascending: when forces set in or cease
  std::uint64_t steps_ = 0;       // of step_ that have begun
  double from_ = 0, to_ = 0;      // s
  double length_ = 0;             // s
};

}  // namespace carom
