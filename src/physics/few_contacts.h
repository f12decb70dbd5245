#pragma once
// The problem of complementarity.h for few pairs, solved to rounding: a light body between heavy ones makes it as
// ill-conditioned as their masses are unequal, and conjugate gradients stop short of an answer there.
#include <span>

#include "physics/complementarity.h"

namespace carom {

/// Moves u until no pair falls short of its target by more than its slack, as press_apart does, and sets the forces;
/// their guesses are not used. By a dual active set (Goldfarb & Idnani, Math. Programming 27 (1983) 1): pairs that fall
/// short are taken in one by one, those that would have to pull are let go. Whether that came to an end.
bool press_few_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs);

}  // namespace carom
