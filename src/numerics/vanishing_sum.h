#pragma once
// Directions that oppose one another.
#include <cstddef>
#include <span>
#include <vector>

#include "numerics/vec3.h"

namespace carom {

/// The fewest of these unit vectors, `first` among them, of which a sum with positive factors vanishes: the residual is
/// at most `tolerance` where the factor of `first` is 1. Four suffice in space (Caratheodory). Ascending; empty: none.
std::vector<std::size_t> vanishing_sum(std::span<const Vec3> directions, std::size_t first, double tolerance);

}  // namespace carom
