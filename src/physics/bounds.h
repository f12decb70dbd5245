#pragma once
// The range in which doubles can carry a World. A position is rounded to 2^-53 of itself.
// At 10^12 times the smallest size that is 10^-4 of that size, and contact means little there.
// Beyond the bounds nothing is computed: the loader refuses the scene, and a run ends.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct World;

/// The largest coordinate and the longest path (m), as multiples of the smallest size (m).
inline constexpr double farthest_by_size = 1e12;
/// The largest speed (m/s).
inline constexpr double largest_speed = 1e30;
/// The largest acceleration (m/s^2).
inline constexpr double largest_acceleration = 1e30;

/// The smallest radius, height or edge of a body, an obstacle or a wall (m). It is infinite if there is none.
double smallest_size(const World& world);

struct Bounds {
  double place = infinity;       // m, of each coordinate
  double speed = largest_speed;  // m/s

  /// Whether a body's position (m) and velocity (m/s) are within the bounds. A number that is not finite never is.
  bool contain(const Vec3& x, const Vec3& v) const {
    return (x.array().abs() <= place).all() && v.squaredNorm() <= speed * speed;
  }
};

Bounds bounds_of(const World& world);

}  // namespace carom
