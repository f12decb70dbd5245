#pragma once
// Words of the command line -> options, or an error with its remedy. The only place with CLI11, whose texts and exit
// codes never reach the user.
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_options.h"
#include "commands/terminal.h"
#include "study/shard.h"

namespace carom {

/// The command line is wrong. The text is for the user.
struct UsageError : std::runtime_error {
  explicit UsageError(const std::string& text) : runtime_error(text), fault(text) {}
  /// The text is "fault: remedy".
  UsageError(const std::string& what, const std::string& what_to_do)
      : runtime_error(what + ": " + what_to_do), fault(what), remedy(what_to_do) {}
  std::string fault, remedy;  // an empty remedy: unknown
};

enum class ProgressChoice { automatic, bar, lines, none };

/// A requested chart: x:y, or x:y:by.
struct ChartWords {
  std::string x, y, by;
};

/// Of compare.
struct CompareOptions {
  std::vector<std::string> measures;
  std::vector<ChartWords> charts;
  bool collisions = false;
  bool video = false;
};

/// Of sweep and submit: what varies.
struct SweepWords {
  std::vector<std::string> grid;               // path=from:to:count, path=value,value, path=from:to
  std::optional<std::uint64_t> random, latin;  // numbers of samples
  std::optional<std::uint64_t> repeat;         // seeds of each run
  bool skip_invalid = false;
  bool plan = false;  // show, do not do
};

/// Of submit.
struct SubmitOptions {
  bool slurm = false;
  std::optional<std::size_t> parts;  // of a sweep
  std::vector<std::string> batch;    // further options of the batch system
};

/// How runs are done. No result depends on it.
struct Execution {
  std::optional<std::uint64_t> jobs;     // runs at a time
  std::optional<std::uint64_t> threads;  // of each run
  std::optional<double> checkpoint_s;    // s, wall time; 0: never
};

/// The options of one command. A command that lacks an option leaves its default.
struct Options {
  std::vector<std::string> operands;             // scene files or other operands, in order
  std::optional<std::string> output;             // folder
  std::vector<std::string> set;                  // path=value
  std::optional<std::vector<std::string>> only;  // names of outputs, not empty
  std::optional<std::uint64_t> seed;
  Execution execution;
  bool force = false;
  bool quiet = false;
  bool json = false;
  ProgressChoice progress = ProgressChoice::automatic;
  ColorChoice color = ColorChoice::automatic;
  BenchOptions bench;
  CompareOptions compare;
  SubmitOptions submit;
  SweepWords sweep;
  std::optional<Shard> shard;
  bool watch = false;        // of run: again at each save
  bool accuracy = false;     // of check and run: estimate the error by more runs
  bool page = false;         // of explain: the whole format
  std::optional<double> at;  // s, of render: the time of a still
};

/// An option that a command has, by its name in the table of options (options.h).
struct OptionUse {
  std::string_view name;       // "--jobs"
  std::string_view help = {};  // its meaning for this command; empty: the table's text
};

/// One command: its operands, options and help. Every command has --color, --json, --quiet and --help too.
struct CommandText {
  std::string name;                // "run"
  std::string line;                // one sentence
  std::string examples;            // lines, first in the help
  std::string notes;               // lines, last in the help
  std::vector<OptionUse> options;  // in the order of the help
  std::string operand = "SCENE";   // name of the operands
  std::string operand_help = "scene files (YAML)";
  std::size_t least = 1, most = std::numeric_limits<std::size_t>::max();  // number of operands
  // Error for too few operands.
  std::string missing = "name a scene file: carom {} scenes/two_bowling_balls.yaml";
};

/// Reads the words after the command's name. Throws UsageError. `help`: the text, if --help was given.
struct ParsedOptions {
  Options options;
  std::optional<std::string> help;
};
ParsedOptions parse_options(const CommandText& command, const std::vector<std::string>& words);

}  // namespace carom
