#pragma once
// `carom explain`: the meaning of a key of the format.
#include "commands/command_line.h"

namespace carom {

const CommandText& explain_text();
int explain_command(const Options& options);

}  // namespace carom
