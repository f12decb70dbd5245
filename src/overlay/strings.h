#pragma once
// Strings and rods as strokes between their ends.

#include "overlay/moment.h"
#include "render/drawing.h"
#include "std.h"

namespace carom {

/// The visible strings whose bodies are in the world. A string ends at the centres of its bodies. A slack one hangs as
/// gravity makes it hang; without gravity it is a straight line.
void add_strings(const Moment& moment, vector<Stroke>& strokes);

}  // namespace carom
