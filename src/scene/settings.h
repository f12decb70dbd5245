#pragma once
// --set path=value: changes the tree of a scene as if the file held the value.

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Applies sources[index], "path=value", to the tree. A path is checked like a key, and an invalid one adds an error.
/// Missing keys are created. Missing names of things are not.
/// The new value replaces a key that excludes it (mass, density).
void apply_setting(Node& root, vector<Source>& sources, uint32_t index, Diagnostics& diagnostics);

}  // namespace carom
