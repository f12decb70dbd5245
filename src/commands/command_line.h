#pragma once
// Words of the command line -> options, or an error with its remedy. The only place with CLI11, whose texts and exit
// codes never reach the user.

#include "commands/options.h"
#include "std.h"

namespace carom {

/// Reads the words after the command's name. Throws UsageError. `help`: the text, if --help was given.
struct ParsedOptions {
  Options options;
  optional<string> help;
};
ParsedOptions parse_options(const Command& command, const vector<string>& words);

}  // namespace carom
