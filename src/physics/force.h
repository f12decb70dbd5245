#pragma once
// The accelerations that gravity and the World's forces give a body: constant between the instants at which a force
// sets in or ceases.
#include "physics/world.h"

namespace carom {

/// m/s^2, from `time` (s) on: a force counts from its `from` until just before its `until`.
Vec3 free_acceleration(const World& world, Entity body, double time);

/// The first instant after `time` (s) at which a force on this body sets in or ceases; infinity: none.
double next_switch(const World& world, Entity body, double time);

}  // namespace carom
