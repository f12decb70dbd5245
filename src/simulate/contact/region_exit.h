#pragma once
// The regions of bodies (neighbours.h): the times at which they leave them, and new ones.

#include "simulate/contact/exact_bodies.h"
#include "std.h"

namespace carom {

/// A time (s) before which body i is certainly within its region, or a time later than its event.
double region_exit(const ExactBodies& bodies, Entity i);

/// Gives body i a new region about its present position. It extends along half of the path to the instant `until` (s).
/// Returns the bodies that are new among its neighbours, valid until regions change.
span<const Entity> renew_region(ExactBodies& bodies, Entity i, double until);

}  // namespace carom
