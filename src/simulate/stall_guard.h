#pragma once
// A run that would never end is stopped: one in which events go on and on while the clock stands still. Elastic impacts
// cannot collapse, and unequal masses have millions of them in an instant (Galperin's billiard): of these, and of
// events without physics, it takes a thousand times as many, or that the clock moves by its rounding at most.
#include <cstdint>

namespace carom {

class StallGuard {
 public:
  /// duration: s, of the run.
  StallGuard(std::uint64_t bodies, double duration) : many_(1'000'000 + 1000 * bodies), duration_(duration) {}

  enum class Happened : std::uint8_t { region_left, impact, other };

  /// An impact with this restitution happens.
  void note_restitution(double e) { restitution_ = e; }
  /// Counts an event at `now` (s). Throws SimulationError where the clock stands still.
  void count(Happened what, double now);

 private:
  /// How the clock goes on from event to event.
  struct Watch {
    std::uint64_t events = 0;
    double since = 0;  // s, the clock when it was last found to go on,
    double seen = -1;  // and when it was last looked at
  };

  const std::uint64_t many_;  // events
  const double duration_;     // s
  Watch elastic_, lossy_;     // of elastic impacts and regions left; of all else
  double restitution_ = 0;    // of the last impact
  double highest_ = 0;        // restitution of late
};

}  // namespace carom
