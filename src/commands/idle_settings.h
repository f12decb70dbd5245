#pragma once
// The --set options that change nothing of what is written.

#include "scene/scene.h"
#include "std.h"

namespace carom {

/// One sentence for each of them: "--set output.frames.from=1 changes nothing: the output `frames` is not written".
/// `set`: the options, each valid. `written`: the scene with all of them, and the outputs that are written.
/// `written_with`: the same with these options alone; it may throw. It is called only if no cheaper answer exists.
vector<string> idle_settings(const vector<string>& set, const Scene& written,
                             const function<Scene(const vector<string>& set)>& written_with);

}  // namespace carom
