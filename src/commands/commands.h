#pragma once
// The table of commands.
#include <vector>

#include "commands/command_line.h"

namespace carom {

struct Command {
  const CommandText& text;
  int (*run)(const Options&);  // gives the exit code
};

/// In the order of the help.
const std::vector<Command>& commands();

}  // namespace carom
