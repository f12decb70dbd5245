#pragma once
// The quantities that a force may depend on.
#include "numerics/vec3.h"

namespace carom {

struct Particle {
  Vec3 x;       // m
  Vec3 v;       // m/s
  double mass;  // kg
};

}  // namespace carom
