#pragma once
// The number of a body or a fixed thing.

#include "std.h"

namespace carom {

/// A body or a fixed thing, by number. Bodies have the numbers 0 .. body_count()-1. Planes, walls, obstacles
/// and strings follow.
using Entity = uint32_t;
inline constexpr Entity no_entity = numeric_limits<Entity>::max();

}  // namespace carom
