#pragma once
// Colour maps: colours along a line, for quantities.

#include "scene/colors.h"
#include "std.h"

namespace carom {

/// Each becomes lighter from its start to its end, so that it keeps its order in print without colours. The part that
/// is too dark to be told from black is left out.
enum class ColorMap : uint8_t { viridis, cividis, magma, plasma, inferno };

// In the order of ColorMap.
inline constexpr string_view color_map_names = "viridis|cividis|magma|plasma|inferno";

/// The colour at `at`, from 0 to 1. Values outside have the colour of the nearer end.
Color color_in(ColorMap map, double at);

}  // namespace carom
