#pragma once
// Every option of every command, in one table: the parser, the helps, the manual page and the shell's completion are
// made from it.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command_line.h"

namespace carom {

struct Option {
  std::string_view name;         // "--output"
  std::string_view letter = {};  // "-o"
  std::string_view value = {};   // what its value is called; empty: it takes none
  std::string_view help;         // lines
  /// Reads the values it was given, at least one (of one without a value: as many empty texts). Throws UsageError.
  void (*read)(Options& options, const std::vector<std::string>& words);
  std::span<const std::string_view> choices = {};  // all that a value may be
};

/// All rows.
std::span<const Option> all_options();

/// The row of this name; there must be one.
const Option& option_named(std::string_view name);

/// A command's options in the order of its help: its own, then those of all commands.
std::vector<OptionUse> options_of(const CommandText& command);

/// The outputs that --only knows.
const std::vector<std::string>& output_names();

/// "; did you mean `x`?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace carom
