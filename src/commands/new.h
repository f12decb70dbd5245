#pragma once
// `carom new`: a scene to start from.

#include "commands/command_line.h"
#include "std.h"

namespace carom {

/// The scene that `carom new` writes: complete, with explanatory comments.
string_view starting_scene();

const CommandText& new_text();
/// Throws UsageError, ExportError.
int new_command(const Options& options);

}  // namespace carom
