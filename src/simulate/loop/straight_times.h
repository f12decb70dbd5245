#pragma once
// Times of impact of one ball with many others under the same acceleration, for which relative paths are straight.
// Two, four or eight pairs are computed at a time, as the processor allows.
// The arithmetic is that of sphere_contact_time (contact_time.h) in the same order, so that the bits are the same.
// Pairs that need more than a quadratic are left to that function.

#include "simulate/path/flight.h"
#include "std.h"

namespace carom {

/// Marks a pair that only sphere_contact_time can decide, because it touches or grazes.
inline constexpr double unsure = -infinity;

struct Meet {
  Instant time;  // hi may be `unsure`
  Entity with;
};

/// The task: impacts of body i with others. None of them is in an island, and all have the same acceleration.
struct StraightTask {
  const Flights::Core* flights;
  const double* radius;  // m, by body; null: all have own_radius
  double own_radius;     // m, of body i
  Entity i;
  span<const Entity> others;
  Vec3 a;       // m/s^2
  bool latest;  // no other flight began after that of body i
  double end;   // s, later impacts are left out
};

/// Writes the impacts, independently of each other, in the others' order. Returns their number. `found` needs room for
/// as many as there are others.
size_t straight_times(const StraightTask& task, Meet* found);

/// The kernels that straight_times can choose from on this processor.
using StraightKernel = size_t (*)(const StraightTask& task, Meet* found);
vector<StraightKernel> straight_kernels();

}  // namespace carom
