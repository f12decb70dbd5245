#pragma once
// The paths of bodies during the last seconds, as strokes.

#include "overlay/moment.h"
#include "render/drawing.h"
#include "std.h"

namespace carom {

/// The strokes of a trail lie within a quarter of a pixel from the path. Their opacity falls from 1 at the moment's
/// time to 0 at the trail's age. They have the colour that the body had in the middle of each.
void add_trails(const Moment& moment, vector<Stroke>& strokes);

}  // namespace carom
