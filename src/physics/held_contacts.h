#pragma once
// Contacts that hold, whichever way it takes: what complementarity.h makes of pairs that are known to press.
#include <span>

#include "physics/complementarity.h"

namespace carom {

/// Changes u, by as little as kinetic energy tells, so that every pair's normal . (u_b - u_a) is its target, and sets
/// the forces: negative ones pull. For few pairs: by Cholesky's factors of the matrix of complementarity.h; of pairs
/// that say the same only one is heard.
void hold(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs);

}  // namespace carom
