#pragma once
// By how much a run is off a reference.
#include <cstdint>
#include <vector>

#include "bench/recorded_run.h"

namespace carom {

struct Differences {
  double position = 0;                     // m: the greatest distance of a body from where the reference has it
  double velocity = 0;                     // m/s, the same
  double energy = 0;                       // J: the greatest difference of the bodies' kinetic and potential energy
  std::uint64_t missed = 0, invented = 0;  // collisions
};

/// The larger one of each.
Differences larger(const Differences& a, const Differences& b);

/// At `instants` (s), both runs' own, and over all collisions before the last of them; those after `until` (s) do not
/// count.
///
/// Two collisions of the same two things are one and the same if their times are nearer to each other than the two
/// need to pass through each other (the sum of their radii over their speed of approach), each to one only, in turn.
/// Those of the reference that are left are missed, those of the run invented, but for two kinds: slow ones, of less
/// than 1/100 of the greatest speed (bounces that die away, of which no two engines see the same number), and those so
/// near the end of the run that their counterpart may lie beyond it.
///
/// The velocity and energy of a body count as long as both runs are on the same side of its collisions: not between the
/// times that the two give for the same collision, where they differ by all that the collision changes.
Differences differences(const World& world, const RecordedRun& reference, const RecordedRun& run,
                        const std::vector<double>& instants, double until);

}  // namespace carom
