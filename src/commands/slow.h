#pragma once
// Scenes that take long, or that doubles do not resolve, by their sizes and masses.
#include <string>

namespace carom {

struct Scene;

/// What makes a scene slow, and the remedy; empty: nothing is known to.
std::string slow_text(const Scene& scene);

}  // namespace carom
