#pragma once
// The --set options that change nothing of what is written.
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// One sentence for each of them: "--set output.frames.from=1 changes nothing: the output `frames` is not written".
/// `set`: the options, each valid. `written`: the scene with all of them, and the outputs that are written.
/// `written_with`: the same with these options alone; it may throw. It is called only if no cheaper answer exists.
std::vector<std::string> idle_settings(const std::vector<std::string>& set, const Scene& written,
                                       const std::function<Scene(const std::vector<std::string>& set)>& written_with);

}  // namespace carom
