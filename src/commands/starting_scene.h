#pragma once
// A scene to start from.

#include "std.h"

namespace carom {

/// The scene that `carom new` writes: complete, with explanatory comments.
string_view starting_scene();

}  // namespace carom
