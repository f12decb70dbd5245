#pragma once
// --set path=value: the tree of a scene as if the file had said so.
#include <cstdint>
#include <vector>

#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Applies sources[index], "path=value", to the tree. A path is checked like a key; one that leads nowhere adds an
/// error. Missing keys are made, missing names of things are not. What is set replaces a key that excludes it (mass,
/// density).
void apply_setting(Node& root, std::vector<Source>& sources, std::uint32_t index, Diagnostics& diagnostics);

}  // namespace carom
