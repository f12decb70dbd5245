#pragma once
// The differences of a run from a reference.

#include "bench/recorded_run.h"
#include "std.h"

namespace carom {

struct Differences {
  /// In m: the greatest distance of a body from its position in the reference.
  double position = 0;
  double velocity = 0;  // m/s, likewise
  /// In J: the greatest difference of the bodies' kinetic and potential energy.
  double energy = 0;
  uint64_t missed = 0, invented = 0;  // collisions
};

/// The larger value of each member.
Differences larger(const Differences& a, const Differences& b);

/// Compares two runs at `instants` (s), which both must have, and all collisions before the last of them.
/// Instants and collisions after `until` (s) do not count.
///
/// Two collisions of the same two things match if their times are close enough, each with one only, in order.
/// Close enough is the time in which the two would pass through each other: the sum of their radii over their speed.
/// Unmatched collisions of the reference are missed, those of the run are invented. Two kinds do not count:
/// - slow ones, of less than 1/100 of the greatest speed, which are bounces that die away and differ between engines;
/// - those so near the end of the run that their counterpart may come after it.
///
/// A body's velocity and energy count only while both runs are on the same side of its collisions.
/// Between the two times of a matched collision they differ by the whole change of the collision.
Differences differences(const World& world, const RecordedRun& reference, const RecordedRun& run,
                        const vector<double>& instants, double until);

}  // namespace carom
