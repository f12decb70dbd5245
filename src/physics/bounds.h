#pragma once
// How far doubles carry a World. A place is rounded to 2^-53 of itself: at 10^12 of the smallest size that is 10^-4 of
// it, and contact there means little. Beyond, nothing is computed: the loader refuses, and a run ends.
#include <limits>

#include "numerics/vec3.h"

namespace carom {

struct World;

/// The largest place (m), and the longest path (m), by the smallest size (m).
inline constexpr double farthest_by_size = 1e12;
/// m/s, m/s^2: what speeds and accelerations may be.
inline constexpr double largest_speed = 1e30, largest_acceleration = 1e30;

/// m: the smallest radius, height or edge of a body, an obstacle or a wall; infinite: there is none.
double smallest_size(const World& world);

struct Bounds {
  double place = std::numeric_limits<double>::infinity();  // m, of each coordinate
  double speed = largest_speed;                            // m/s

  /// Whether a body's place (m) and velocity (m/s) are within these; a number that is not finite never is.
  bool hold(const Vec3& x, const Vec3& v) const {
    return (x.array().abs() <= place).all() && v.squaredNorm() <= speed * speed;
  }
};

Bounds bounds_of(const World& world);

}  // namespace carom
