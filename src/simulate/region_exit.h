#pragma once
// When bodies leave their regions (neighbours.h).
#include "simulate/exact_bodies.h"

namespace carom {

/// A time (s) before which body i is surely within its region, or that is later than its event.
double region_exit(const ExactBodies& bodies, Entity i);

}  // namespace carom
