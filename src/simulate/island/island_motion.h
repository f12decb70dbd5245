#pragma once
// The steps of islands, by the one of two ways in which each of them moves now.
#include "simulate/island/constrained_motion.h"
#include "simulate/island/time_stepping.h"

namespace carom {

class PathLog;

class IslandMotion {
 public:
  IslandMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat,
               CollapseDetector& collapses, FlightChanges& flights, PathLog& paths)
      : bodies_(bodies),
        paths_(paths),
        stepping_(bodies, modes, group, flights),
        constrained_(bodies, modes, group, flat, collapses, flights) {}

  /// Takes the next step of body i's island. Islands with taut strings move by constrained motion.
  void advance(Entity i);

  /// The number of steps so far along paths that are not exact, but for rounding.
  std::uint64_t inexact_steps() const { return constrained_.inexact_steps(); }
  /// Appends the forces in an island that moves by constrained motion, at `time` (s).
  void report(const Island& island, double time, std::vector<ContactForce>& forces) const {
    constrained_.report(island, time, forces);
  }

 private:
  ExactBodies& bodies_;
  PathLog& paths_;
  TimeStepping stepping_;
  ConstrainedMotion constrained_;
};

}  // namespace carom
