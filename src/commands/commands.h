#pragma once
// Every command there is.
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
