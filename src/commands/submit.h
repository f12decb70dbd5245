#pragma once
// carom submit: a script that runs a sweep as a job array.
#include "commands/command_line.h"

namespace carom {

const CommandText& submit_text();
int submit_command(const Options& options);

}  // namespace carom
