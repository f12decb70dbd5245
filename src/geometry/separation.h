#pragma once
// The position of a point relative to a convex set: what conservative_advancement.h needs from the Minkowski sums.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct Separation {
  double gap;  // m, negative: inside, the depth of the shortest way out
  // Unit, outward. The set lies wholly beyond the plane with this normal at this gap.
  Vec3 normal;
  uint8_t feature;  // the nearest part of the surface
};

}  // namespace carom
