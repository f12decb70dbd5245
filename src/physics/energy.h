#pragma once
// Conserved sums of a State. The sums are compensated and follow the order of the bodies.
#include "physics/state.h"

namespace carom {

struct World;

double kinetic_energy(const World& world, const State& state);    // J
double potential_energy(const World& world, const State& state);  // J, of gravity and forces (force.h)
Vec3 momentum(const World& world, const State& state);            // kg m/s

}  // namespace carom
