#pragma once
// The problem of complementarity.h, roughly and at once: pair after pair, there and back again, is given the force that
// it alone needs (projected Gauss-Seidel). From the forces of a moment ago a few sweeps are enough for bodies in
// motion; it never gets as near to the answer as press_apart does.
#include <span>

#include "physics/complementarity.h"

namespace carom {

/// Moves u towards the motion that press_apart finds, in at most `sweeps` of all pairs; fewer once no pair is off by
/// more than its slack. Whether that was so.
bool sweep_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs, int sweeps);

}  // namespace carom
