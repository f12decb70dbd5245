#pragma once
// The program except main(): picks the command and reports errors.
#include <string>
#include <vector>

namespace carom {

/// `words`: the command line without the program's own name. Gives the exit code; throws nothing.
int run_program(const std::vector<std::string>& words);

}  // namespace carom
