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

/// The answers of a sum at whose edges no face has to be chosen: none counts as sharp.
struct BluntSum {
  bool sharp(uint8_t) const { return false; }
  Vec3 within(const Vec3& p, uint8_t) const { return p; }
  uint8_t foremost_face(const Vec3&, uint8_t feature) const { return feature; }
  void for_each_face(uint8_t, const auto&) const {}
  bool rim_gap(uint8_t, const auto&, double, double&) const { return false; }
};

}  // namespace carom
