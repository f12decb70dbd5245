#pragma once
// Stops a run that would never end, because events continue while the clock stands still.
// Elastic impacts cannot collapse, and unequal masses have millions of them in an instant (Galperin's billiard).
// For these, and for events without physics, the limit is a thousand times as high, or progress by no more than the
// clock's rounding.

#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

class StallGuard {
 public:
  /// duration: of the run (s).
  StallGuard(uint64_t bodies, double duration) : many_(1'000'000 + 1000 * bodies), duration_(duration) {}

  enum class Happened : uint8_t { region_left, region_crossed, impact, other };

  /// Registers the restitution of an impact, and whether a moving thing took part. Elastic impacts between things that
  /// close in on a body have no end.
  void note_restitution(double e, bool moving = false) {
    restitution_ = e;
    moving_ = moving;
  }
  /// Counts an event at `now` (s). Throws SimulationError where the clock stands still.
  void count(Happened what, double now);

  /// Events within this span (s) count as those of one instant.
  void set_close(double span) { close_ = span; }
  /// Whether so many events have happened at this instant that their rounds may be endless.
  bool may_be_endless() const { return at_instant_ >= exact_tolerance::rounds_of_events; }

  void keep(auto& archive) {
    archive(elastic_, lossy_, restitution_, moving_, instant_, at_instant_, highest_, lowest_, moved_);
  }

 private:
  /// The progress of the clock over many events.
  struct Watch {
    uint64_t events = 0;
    double since = 0;     // s, the clock when it was last found to advance
    double checked = -1;  // s, the clock at the last check
  };

  const uint64_t many_;    // events
  const double duration_;  // s
  // For elastic impacts and exits from regions, and for all other events.
  Watch elastic_, lossy_;
  double restitution_ = 0;  // of the last impact
  bool moving_ = false;     // a moving thing took part in it
  // The present instant (s), its length (s) and its events.
  double instant_ = 0;
  double close_ = 0;
  uint32_t at_instant_ = 0;
  // Of recent impacts: the greatest restitution and the least one, and whether moving things took part.
  double highest_ = 0, lowest_ = 1;
  bool moved_ = false;
};

}  // namespace carom
