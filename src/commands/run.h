#pragma once
// carom run: scenes -> folders of results.
#include "commands/command_line.h"

namespace carom {

const CommandText& run_text();
/// The program's exit code. Throws UsageError, Interrupted.
int run_command(const Options& options);

}  // namespace carom
