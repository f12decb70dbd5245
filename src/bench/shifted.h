#pragma once
// The same scene at another place.
// Its motion is the same except for rounding, so a run of it shows the effect of rounding.
#include "physics/state.h"
#include "physics/world.h"

namespace carom {

/// The world with all positions moved by `by` (m).
World shifted(const World& world, const Vec3& by);
State shifted(State state, const Vec3& by);

/// In m: the greatest distance of any point of a body from the origin at the start.
double extent(const World& world, const State& initial);

/// In m: 2^-53 of the extent. Smaller distances are rounding.
double rounding_of(const World& world, const State& initial);

/// In m: 0.5 to 1.5 extents along each axis, by irrational numbers. Each `number`, from 1 on, gives another shift.
Vec3 shift(double extent, int number);

}  // namespace carom
