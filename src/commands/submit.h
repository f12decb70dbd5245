#pragma once
// carom submit: a sweep as a job array of a batch system.
#include "commands/command_line.h"

namespace carom {

const CommandText& submit_text();
int submit_command(const Options& options);

}  // namespace carom
