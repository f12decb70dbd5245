#pragma once
// carom render DIR...: other pictures of motions that were simulated before.
#include "commands/command_line.h"

namespace carom {

const CommandText& render_text();
int render_command(const Options& options);

}  // namespace carom
