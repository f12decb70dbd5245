#pragma once
// Bodies that are of another order of size than the rest, as a mesh in millimetres is.

#include "std.h"

namespace carom {

struct Scene;

/// A sentence for each body, group or obstacle that is at least 1,000 times larger or smaller than the median of the
/// others, with the remedy.
vector<string> odd_sizes(const Scene& scene);

}  // namespace carom
