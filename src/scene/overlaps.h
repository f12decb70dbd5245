#pragma once
// Overlaps of bodies with one another or with fixed things at the start.

#include "physics/entity.h"
#include "scene/grid.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

struct Scene;

/// A body that the scene places individually.
struct SingleBody {
  Entity body;
  /// The place of its position in the file.
  Place position;
};

/// Adds an error for each body that overlaps another body, a plane, a wall or an obstacle. Many are one error, with the
/// deepest overlap.
/// Those that come later may overlap bodies, and things that move. The tolerance is 1e-9 of the smaller one's reach.
/// Then the other bodies and the obstacles are inserted into `grid`, and these alone into `obstacles`.
/// `singles`: in the order of their numbers. Their part of the world and of the initial state must be decoded.
void check_overlaps(const Scene& scene, vector<SingleBody> singles, BodyGrid& grid, BodyGrid& obstacles,
                    Diagnostics& diagnostics);

}  // namespace carom
