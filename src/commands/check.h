#pragma once
// carom check: what a run would do, without running it or writing anything.
#include "commands/command_line.h"

namespace carom {

const CommandText& check_text();
/// The program's exit code. Throws UsageError, Interrupted.
int check_command(const Options& options);

}  // namespace carom
