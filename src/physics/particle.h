#pragma once
// The quantities that a force may depend on.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The reach of a force that is smooth everywhere (m).
inline constexpr double everywhere = infinity;

struct Particle {
  Vec3 x;       // m
  Vec3 v;       // m/s
  double mass;  // kg
};

}  // namespace carom
