#pragma once
// --only: fewer or other outputs than a scene asks for. The scene's resolved text stays as it is, so that runs of one
// scene with different outputs are known to be the same scene's.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// Of what the scene asks for, the outputs named (output_names() of command_line.h), with the scene's settings. One
/// that it does not ask for gets default settings; frames and video take each other's.
Output restricted(const Output& asked, const std::vector<std::string>& only);

/// Whether every output named is among those asked for.
bool holds_all(const Output& asked, const std::vector<std::string>& only);

}  // namespace carom
