#pragma once
// The quantities that a force may depend on.
#include <limits>

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The reach of a force that is smooth everywhere (m).
inline constexpr double everywhere = numeric_limits<double>::infinity();

struct Particle {
  Vec3 x;       // m
  Vec3 v;       // m/s
  double mass;  // kg
};

}  // namespace carom
