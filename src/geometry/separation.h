#pragma once
// Where a point lies to a convex set: what conservative_advancement.h asks of the Minkowski sums.
#include <cstdint>

#include "numerics/vec3.h"

namespace carom {

struct Separation {
  double gap;            // m, negative: inside, by the least way out
  Vec3 normal;           // unit, outward; the set lies wholly beyond the plane with this normal at this gap
  std::uint8_t feature;  // the nearest part of the surface
};

}  // namespace carom
