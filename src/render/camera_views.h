#pragma once
// What a camera that frames the motion shows at each instant.

#include "scene/scene.h"
#include "std.h"

namespace carom {

struct CameraViews {
  Camera camera;          // without a path at all times
  vector<Keyframe> path;  // ascending; empty: it stands still
  /// Walls and obstacles that hide what happens from wherever it is seen, ascending. Numbers among all fixed things.
  vector<uint32_t> faded;
};

}  // namespace carom
