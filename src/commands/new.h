#pragma once
// `carom new`: a scene to start from.
#include <string_view>

#include "commands/command_line.h"

namespace carom {

/// The scene that `carom new` writes: complete, with explanatory comments.
std::string_view starting_scene();

const CommandText& new_text();
/// Throws UsageError, ExportError.
int new_command(const Options& options);

}  // namespace carom
