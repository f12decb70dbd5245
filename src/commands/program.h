#pragma once
// The program except main(): picks the command and reports errors.

#include "std.h"

namespace carom {

/// Of the tree that the program was built from: ten digits, and a mark where sources have changed since. Empty: not
/// known. It is in the program alone, in no library: commit.cmake writes its source.
extern const char* const program_commit;

/// `words`: the command line without the program's own name. Gives the exit code; throws nothing.
/// `commit` is shown by --version beside the version.
int run_program(const vector<string>& words, const string& commit);

}  // namespace carom
