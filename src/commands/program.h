#pragma once
// The program except main(): picks the command and reports errors.

#include "std.h"

namespace carom {

/// `words`: the command line without the program's own name. Gives the exit code; throws nothing.
int run_program(const vector<string>& words);

}  // namespace carom
