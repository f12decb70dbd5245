#pragma once
// A body's path since its last change: x + v t + a t^2/2 from its start on.
#include "physics/vec3.h"
#include "simulate/instant.h"

namespace carom {

struct Flight {
  Instant start;
  Vec3 x;  // m, at start
  Vec3 v;  // m/s, at start
  Vec3 a;  // m/s^2

  Vec3 position(double t) const { return x + t * (v + (0.5 * t) * a); }  // t: s since start
  Vec3 velocity(double t) const { return v + t * a; }
};

}  // namespace carom
