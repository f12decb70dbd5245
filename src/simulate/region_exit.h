#pragma once
// The times at which bodies leave their regions (neighbours.h).
#include "simulate/exact_bodies.h"

namespace carom {

/// A time (s) before which body i is certainly within its region, or a time later than its event.
double region_exit(const ExactBodies& bodies, Entity i);

}  // namespace carom
