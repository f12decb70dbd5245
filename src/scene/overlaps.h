#pragma once
// Bodies that stand in one another, or in something fixed, at the start.
#include <vector>

#include "physics/entity.h"
#include "scene/grid.h"
#include "yaml/diagnostics.h"

namespace carom {

struct Scene;

/// A body that the scene places itself.
struct SingleBody {
  Entity body;
  Place position;  // where the file says so
};

/// Adds an error for each that overlaps another, a plane, a wall or an obstacle by more than 1e-9 of the smaller one's
/// reach, and puts the bodies and the obstacles into `grid`. `singles`: by number, their part of the world and of the
/// initial state decoded.
void check_overlaps(const Scene& scene, std::vector<SingleBody> singles, BodyGrid& grid, Diagnostics& diagnostics);

}  // namespace carom
