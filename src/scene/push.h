#pragma once
// `overlap: push`: balls that overlap a little at time 0 are moved apart.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct World;

/// A ball and what it still overlaps.
struct PushedPair {
  Entity ball, other;
  double depth;  // m
};

/// Overlaps of at least this share of the smaller radius are not pushed apart.
inline constexpr double most_pushed = 1e-3;

/// Moves the balls `movable` (ascending) so that they overlap neither one another nor the bodies `others` nor fixed
/// things. Two balls share the way, and others stay. If any overlap is too deep, nothing moves: that is for the check
/// of overlaps. `position`: m, by body. The result depends on the places alone and not on the order of the balls, up
/// to rounding. Returns the deepest overlap that is left where there is no room; none: nothing overlaps.
optional<PushedPair> push_apart(const World& world, span<const Entity> movable, span<const Entity> others,
                                vector<Vec3>& position);

}  // namespace carom
