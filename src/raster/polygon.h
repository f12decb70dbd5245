#pragma once
// The outline of a box, a cylinder or a wall in the plane z = 1 before the eye: a convex polygon.

#include "numerics/vec3.h"
#include "raster/shot.h"
#include "std.h"

namespace carom::raster {

/// In the plane z = 1.
struct PlanePoint {
  double x, y;
};

/// The corners, counterclockwise; fewer than 3: nothing is before the near plane.
vector<PlanePoint> outline_polygon(const Shot& shot, const Solid& solid);

inline Vec3 vec(const Float3& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace carom::raster
