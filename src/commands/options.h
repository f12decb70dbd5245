#pragma once
// The table of all options. The parser, the helps, the manual page and the shell's completion are made from it.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command_line.h"

namespace carom {

struct Option {
  std::string_view name;         // "--output"
  std::string_view letter = {};  // "-o"
  std::string_view value = {};   // name of its value; empty: it takes none
  std::string_view help;         // lines
  /// Reads its values, at least one; a flag has an empty text for each use. Throws UsageError.
  void (*read)(Options& options, const std::vector<std::string>& words);
  std::span<const std::string_view> choices = {};  // the allowed values
};

/// All rows.
std::span<const Option> all_options();

/// The row of this name; there must be one.
const Option& option_named(std::string_view name);

/// A command's options in the order of its help: its own, then those of all commands.
std::vector<OptionUse> options_of(const CommandText& command);

/// The names of outputs for --only.
const std::vector<std::string>& output_names();

/// "; did you mean `x`?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace carom
