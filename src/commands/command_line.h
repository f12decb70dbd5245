#pragma once
// The words of the command line -> options, or a text that says what is wrong and what to do. The only place with
// CLI11, whose own texts and exit codes the user never meets.
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/terminal.h"
#include "study/bench.h"

namespace carom {

/// The command line is wrong. The text is for the user.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class ProgressChoice { automatic, bar, lines, none };

/// What one command was asked to do. A command that lacks an option leaves its default.
struct Options {
  std::vector<std::string> scenes;               // files, in order, at least one
  std::optional<std::string> output;             // folder
  std::vector<std::string> set;                  // path=value
  std::optional<std::vector<std::string>> only;  // names of outputs, none empty
  std::optional<std::uint64_t> seed;
  std::uint64_t jobs = 1;  // scenes at a time; no result depends on it
  bool force = false;
  bool quiet = false;
  bool json = false;
  ProgressChoice progress = ProgressChoice::automatic;
  ColorChoice color = ColorChoice::automatic;
  BenchOptions bench;
};

/// One command: what its help says and which options it has beyond those of all commands.
struct CommandText {
  std::string name;       // "run"
  std::string line;       // one sentence
  std::string examples;   // lines, stand first in the help
  std::string notes;      // lines, stand last
  bool progress = false;  // has --progress
  bool outputs = true;    // has --only
  bool bench = false;     // has the options of BenchOptions
};

/// Reads the words after the command's name. Throws UsageError. `help`: its text was asked for instead.
struct ParsedOptions {
  Options options;
  std::optional<std::string> help;
};
ParsedOptions parse_options(const CommandText& command, const std::vector<std::string>& words);

/// The outputs that --only knows.
const std::vector<std::string>& output_names();

}  // namespace carom
