#pragma once
// The manual page and bash completion, made from the tables of commands and options.

#include "std.h"

namespace carom {

/// carom.1, in roff with the macros of man(7).
string manual_page();

/// What bash sources to complete commands, options, their values and files.
string bash_completion();

}  // namespace carom
