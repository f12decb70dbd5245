#pragma once
// carom plot DIR...: charts of finished runs, without simulating again.
#include "commands/command_line.h"

namespace carom {

const CommandText& plot_text();
/// The program's exit code. Throws UsageError, Interrupted, ExportError.
int plot_command(const Options& options);

}  // namespace carom
