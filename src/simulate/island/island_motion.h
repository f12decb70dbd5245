#pragma once
// The steps of islands, by the one of two ways in which each of them moves now.
#include "simulate/crowd/crowd_motion.h"
#include "simulate/island/constrained_motion.h"
#include "std.h"

namespace carom {

class PathLog;

class IslandMotion {
 public:
  IslandMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat,
               CollapseDetector& collapses, FlightChanges& flights, PathLog& paths)
      : bodies_(bodies),
        paths_(paths),
        crowds_(bodies, modes, group, flights),
        constrained_(bodies, modes, group, flat, collapses, flights) {}

  /// Takes the next step of body i's island. Islands with taut strings move by constrained motion.
  void advance(Entity i);
  /// Ends the present step of member i's island, which is a crowd, at this instant. The next one is due.
  void interrupt(Entity i);
  /// Books the present steps of crowds up to `time` (s), the run's end.
  void book_last(double time) const;

  /// The number of steps so far along paths that are not exact, but for rounding.
  uint64_t inexact_steps() const { return constrained_.inexact_steps(); }
  /// Appends the forces in an island that has taken a step, at `time` (s).
  void report(const Island& island, double time, vector<ContactForce>& forces) const {
    if (bodies_.mode(island.members.front()) == Mode::stepped)
      crowds_.report(island, forces);
    else
      constrained_.report(island, time, forces);
  }

  void keep(auto& archive) { archive(constrained_); }

 private:
  ExactBodies& bodies_;
  PathLog& paths_;
  CrowdMotion crowds_;
  ConstrainedMotion constrained_;
};

}  // namespace carom
