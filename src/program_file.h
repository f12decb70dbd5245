#pragma once
// Where the running program is. In the archive that runs anywhere lib/ has the program beside its own loader of
// libraries, and the script bin/carom starts that loader: then /proc/self/exe is the loader.

#include "std.h"

namespace carom {

/// A name by which the running program's file can be opened.
string program_file();

/// The folder that bin/ with the program is in. Empty: /proc cannot be read.
string program_prefix();

/// The absolute path of what starts this program, for another shell; "carom" where /proc cannot be read.
string program_command();

}  // namespace carom
