#pragma once
// `carom explain`: what a key of the format means.
#include "commands/command_line.h"

namespace carom {

const CommandText& explain_text();
int explain_command(const Options& options);

}  // namespace carom
