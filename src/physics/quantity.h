#pragma once
// The quantities of a body's motion that measures name.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

enum class Quantity : uint8_t { x, y, z, vx, vy, vz, speed, kinetic };

/// Whether the quantity is a coordinate of the position.
constexpr bool is_place(Quantity quantity) {
  return quantity <= Quantity::z;
}

/// A quantity of a body at `position` (m) with `velocity` (m/s) and `mass` (kg).
inline double quantity_of(Quantity quantity, const Vec3& position, const Vec3& velocity, double mass) {
  switch (quantity) {
    case Quantity::x:
    case Quantity::y:
    case Quantity::z:
      return position[int(quantity)];

    case Quantity::vx:
    case Quantity::vy:
    case Quantity::vz:
      return velocity[int(quantity) - int(Quantity::vx)];

    case Quantity::speed:
      return velocity.norm();
    case Quantity::kinetic:
      return 0.5 * mass * velocity.squaredNorm();
  }
  return numeric_limits<double>::quiet_NaN();
}

}  // namespace carom
