#pragma once
// carom gather: joins the parts of a sweep.
#include "commands/command_line.h"

namespace carom {

const CommandText& gather_text();
int gather_command(const Options& options);

}  // namespace carom
