#pragma once
// Springs as helices of strokes from their anchors to the bodies, or between two bodies.

#include "overlay/moment.h"
#include "render/drawing.h"
#include "std.h"

namespace carom {

/// The springs that act at the moment. Each begins at its anchor, or at a body's centre, and ends at one. The number of
/// turns is constant, so that a spring is seen to stretch. A helix narrower than a pixel is a straight line.
void add_springs(const Moment& moment, vector<Stroke>& strokes);

}  // namespace carom
