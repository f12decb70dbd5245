#pragma once
// When a path crosses the boundary of a region (physics/world_region.h).

#include "numerics/polynomial_path.h"
#include "physics/world_region.h"
#include "std.h"

namespace carom {

/// A body's path for `length` (s): a parabola, or a polynomial of degree 8.
struct CenterPath {
  Vec3 x = Vec3::Zero();  // m, at t = 0
  // Of a parabola: velocity (m/s) at t = 0, and acceleration (m/s^2).
  Vec3 v = Vec3::Zero(), a = Vec3::Zero();
  bool parabola = true;
  PolynomialPath::Terms displacement;  // m, in t / length
  double length = 0;                   // s

  static CenterPath along(const Vec3& x, const Vec3& v, const Vec3& a, double length);
  static CenterPath along(const Vec3& x, const PolynomialPath::Terms& displacement, double length);
};

/// When a body crosses the boundary, in s.
struct CrossingTime {
  double at;
  // It is then `margin` beyond the boundary.
  double sure;
};

/// The first crossing from `from` (s) on of a body that was inside before, or was not. Less than `margin` (m) beyond
/// the boundary is no crossing. A body that is there at `from` crosses at `from`.
optional<CrossingTime> next_crossing(const WorldRegion& region, const CenterPath& path, double from, bool inside,
                                     double margin);

}  // namespace carom
