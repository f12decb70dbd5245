#pragma once
// Places the balls of a group.

#include "numerics/random.h"
#include "physics/entity.h"
#include "physics/volume.h"
#include "scene/grid.h"
#include "scene/keys.h"
#include "std.h"

namespace carom {

struct Placing {
  uint64_t count = 0;
  /// First ball of the group.
  Entity first = 0;
  span<const double> radii;  // m, by ball
  /// The space that contains every ball entirely.
  Volume space;
  Vec3 center;    // m, of the space
  Vec3 min, max;  // m, the box around it
  Arrange arrange = Arrange::random;
};

struct Placed {
  vector<Vec3> centers;  // m; as many as requested, or none
  /// If `centers` is empty: the number that would fit.
  uint64_t fit = 0;
};

/// Places balls clear of one another, of `others` (bodies and obstacles) and of the world's planes and walls.
/// - lattice: cubic, the box cut into equal cells.
/// - hexagonal: close-packed layers (ABAB along y) of the widest spacing that holds the count, centred.
/// - random: one ball after the other, the largest first, anywhere that is free.
/// A lattice or hexagonal arrangement with more sites than balls leaves sites out evenly. Each site has room for the
/// largest ball. In a sphere or cylinder the sites are those of the box around it that lie inside.
/// Above about a third of the volume, random placement finds no more room.
/// It then takes a random choice of hexagonal sites and moves each ball at random within its site.
Placed place(const Placing& placing, const World& world, const BodyGrid& others, Random& random);

}  // namespace carom
