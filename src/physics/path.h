#pragma once
// A body's path through a time step: x + v t + a t^2/2 + j t^3/6 from its start on.
#include "physics/vec3.h"

namespace carom {

struct Path {
  Vec3 x = Vec3::Zero();  // m, at t = 0
  Vec3 v = Vec3::Zero();  // m/s, at t = 0
  Vec3 a = Vec3::Zero();  // m/s^2, at t = 0
  Vec3 j = Vec3::Zero();  // m/s^3

  Vec3 position(double t) const { return x + t * (v + (0.5 * t) * (a + (t / 3) * j)); }
  Vec3 velocity(double t) const { return v + t * (a + (0.5 * t) * j); }
  /// The same path seen from time t on.
  Path from(double t) const { return t == 0 ? *this : Path{position(t), velocity(t), a + t * j, j}; }
};

}  // namespace carom
