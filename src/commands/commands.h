#pragma once
// The table of commands.

#include "commands/command_line.h"
#include "std.h"

namespace carom {

struct Command {
  const CommandText& text;
  int (*run)(const Options&);  // gives the exit code
};

/// In the order of the help.
const vector<Command>& commands();

}  // namespace carom
