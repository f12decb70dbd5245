#pragma once
// Directions that oppose one another.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The fewest of these unit vectors, `first` among them, of which a sum with positive factors vanishes: the residual is
/// at most `tolerance` where the factor of `first` is 1. Four suffice in space (Caratheodory). Ascending; empty: none.
vector<size_t> vanishing_sum(span<const Vec3> directions, size_t first, double tolerance);

}  // namespace carom
