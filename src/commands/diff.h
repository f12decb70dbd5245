#pragma once
// carom diff: where two runs diverge, and how far apart they end.
#include "commands/command_line.h"

namespace carom {

const CommandText& diff_text();
/// The program's exit code. Throws UsageError, Interrupted.
int diff_command(const Options& options);

}  // namespace carom
