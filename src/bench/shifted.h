#pragma once
// The same scene elsewhere: its motion is the same but for rounding, so that another run of it tells what rounding
// does.
#include "physics/state.h"
#include "physics/world.h"

namespace carom {

/// All that has a place, `by` (m) further.
World shifted(const World& world, const Vec3& by);
State shifted(State state, const Vec3& by);

/// m: the greatest distance from the origin at which something of a body is at the start.
double extent(const World& world, const State& initial);

/// m: by 0.5 to 1.5 extents along each axis, irrationally; another one for each number from 1 on.
Vec3 shift(double extent, int number);

}  // namespace carom
