#pragma once
// carom sweep: many runs of one scene with other values, and what compares them.
#include "commands/command_line.h"

namespace carom {

const CommandText& sweep_text();
int sweep_command(const Options& options);

}  // namespace carom
