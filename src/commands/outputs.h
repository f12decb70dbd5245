#pragma once
// --only: fewer or other outputs than a scene asks for.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// Leaves of the scene's outputs those named (output_names() of command_line.h), with the scene's settings. One that
/// the scene does not ask for gets default settings; frames and video take each other's. The resolved text follows, so
/// that running it gives the same bytes.
void restrict_outputs(Scene& scene, const std::vector<std::string>& only);

}  // namespace carom
