#pragma once
// Scenes that take long, or that doubles do not resolve, by their sizes and masses.

#include "std.h"

namespace carom {

struct Scene;

/// What makes a scene slow, and the remedy; empty: nothing is known to.
string slow_text(const Scene& scene);

}  // namespace carom
