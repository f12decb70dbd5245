#pragma once
// The centre of mass of some of the bodies.

#include "physics/state.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

/// Of the bodies first, first + 1, ... In m; `count` is at least 1. That of a single body is its position to the bit.
/// Parts of a joint body count with their own masses where the joint body is, so that a merge of two of them does not
/// move it.
inline Vec3 center_of_mass(const World& world, Entity first, Entity count, const vector<Vec3>& position) {
  // Relative to one of them, so that no digits are lost far from the origin.
  const Vec3& origin = position[first];
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (Entity body = first; body < first + count; ++body) {
    moment += world.mass[body] * (position[body] - origin);
    mass += world.mass[body];
  }
  return origin + moment / mass;
}

}  // namespace carom
