#pragma once
// The --set options that change nothing of what is written.
#include <functional>
#include <string>
#include <vector>

#include "scene/output.h"

namespace carom {

/// One sentence for each of them: "--set output.frames.from=1 changes nothing: frames are not written".
/// `set`: the options, each valid. `written`: the outputs with all of them.
/// `written_with`: the outputs with these options alone; it may throw. It is called only if no cheaper answer exists.
std::vector<std::string> idle_settings(const std::vector<std::string>& set, const Output& written,
                                       const std::function<Output(const std::vector<std::string>& set)>& written_with);

}  // namespace carom
