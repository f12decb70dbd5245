#pragma once
// The table of commands (`Command`: options.h). Each has a file of its own.

#include "commands/options.h"
#include "std.h"

namespace carom {

extern const Command run_command, check_command, sweep_command, gather_command, submit_command, compare_command,
    diff_command, render_command, plot_command, bench_command, new_command, schema_command, explain_command;

/// In the order of the help.
const vector<Command>& commands();

}  // namespace carom
