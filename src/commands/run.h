#pragma once
// carom run: scenes -> folders of results.
#include <string_view>
#include <vector>

#include "commands/command_line.h"
#include "commands/plan.h"

namespace carom {

const CommandText& run_text();
/// The program's exit code. Throws UsageError, Interrupted.
int run_command(const Options& options);

/// Runs planned scenes and reports them; `command`: for the document of --json. Returns the program's exit code.
int run_planned(const Options& options, std::string_view command, std::vector<PlannedScene> scenes);

}  // namespace carom
