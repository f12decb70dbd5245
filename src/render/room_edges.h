#pragma once
// The edges where the planes of a scene meet, as strokes. They show a room's near side, which is seen through.

#include "render/drawing.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The finite edges of the convex room between the visible planes; none of a room that is open.
vector<Stroke> room_edges(const Scene& scene);

}  // namespace carom
