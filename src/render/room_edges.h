#pragma once
// The edges where the planes of a scene meet, as strokes. They show a room's near side, which is seen through.
#include <vector>

#include "render/drawing.h"
#include "scene/scene.h"

namespace carom {

/// The finite edges of the convex room between the visible planes; none of a room that is open.
std::vector<Stroke> room_edges(const Scene& scene);

}  // namespace carom
