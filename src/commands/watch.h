#pragma once
// carom run --watch: scenes again at each save.
#include "commands/options.h"

namespace carom {

/// Runs all scenes, and then, until an interrupt, those of which a file has changed. A scene with errors is reported,
/// and watched like the others. Gives the exit code of an interrupt. Throws UsageError, Interrupted.
int watch_scenes(const Options& options);

}  // namespace carom
