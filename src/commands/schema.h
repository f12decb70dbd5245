#pragma once
// `carom schema`: the format as a JSON Schema.
#include "commands/command_line.h"

namespace carom {

const CommandText& schema_text();
int schema_command(const Options& options);

}  // namespace carom
