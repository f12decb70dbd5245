#pragma once
// Three floats in the camera's frame.

#include "std.h"

namespace carom::raster {

using Float3 = array<float, 3>;

inline float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Float3 cross(const Float3& a, const Float3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Float3 unit(const Float3& a) {
  const float length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Unit vectors across a unit vector.
struct Across {
  Float3 u, v;
};
inline Across across(const Float3& l) {
  const Float3 u = unit(cross(l, std::abs(l[0]) < 0.7F ? Float3{1, 0, 0} : Float3{0, 1, 0}));
  return {u, cross(l, u)};
}

}  // namespace carom::raster
