#pragma once
// The table of all options. The parser, the helps, the manual page and the shell's completion are made from it.

#include "commands/options.h"
#include "std.h"

namespace carom {

struct Option {
  string_view name;         // "--output"
  string_view letter = {};  // "-o"
  string_view value = {};   // name of its value; empty: it takes none
  string_view help;         // lines
  /// Reads its values, at least one; a flag has an empty text for each use. Throws UsageError.
  void (*read)(Options& options, const vector<string>& words);
  span<const string_view> choices = {};  // the allowed values
};

/// All rows.
span<const Option> all_options();

/// The row of this name; there must be one.
const Option& option_named(string_view name);

/// A command's options in the order of its help: its own, then those of all commands.
vector<OptionUse> options_of(const Command& command);

/// The names of outputs for --only.
const vector<string>& output_names();

/// "; did you mean `x`?", or nothing.
string did_you_mean(string_view word, const vector<string>& known);

}  // namespace carom
