#pragma once
// carom compare: a table, a workbook and a film of any runs.
#include "commands/command_line.h"

namespace carom {

const CommandText& compare_text();
/// The program's exit code. Throws UsageError, Interrupted.
int compare_command(const Options& options);

}  // namespace carom
