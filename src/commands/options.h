#pragma once
// What a command is, and the options that it is given.

#include "bench/bench_options.h"
#include "commands/terminal.h"
#include "std.h"
#include "study/shard.h"

namespace carom {

/// The command line is wrong. The text is for the user.
struct UsageError : runtime_error {
  explicit UsageError(const string& text) : runtime_error(text), fault(text) {}
  /// The text is "fault: remedy".
  UsageError(const string& what, const string& what_to_do)
      : runtime_error(what + ": " + what_to_do), fault(what), remedy(what_to_do) {}
  string fault, remedy;  // an empty remedy: unknown
};

enum class ProgressChoice { automatic, bar, lines, none };

/// A requested chart: x:y, or x:y:by.
struct ChartWords {
  string x, y, by;
};

/// Of compare.
struct CompareOptions {
  vector<string> measures;
  vector<ChartWords> charts;
  bool collisions = false;
  bool video = false;
};

/// Of sweep and submit: what varies.
struct SweepWords {
  vector<string> grid;               // path=from:to:count, path=value,value, path=from:to
  optional<uint64_t> random, latin;  // numbers of samples
  optional<uint64_t> repeat;         // seeds of each run
  string best;                       // a measure, or an expression of measures; empty: none
  bool skip_invalid = false;
  bool plan = false;  // show, do not do
};

/// Of submit.
struct SubmitOptions {
  bool slurm = false;
  optional<size_t> parts;  // of a sweep
  vector<string> batch;    // further options of the batch system
};

/// How runs are done. No result depends on it.
struct Execution {
  optional<uint64_t> jobs;        // runs at a time
  optional<uint64_t> threads;     // of each run
  optional<double> checkpoint_s;  // s, wall time; 0: never
  bool watch = false;             // again at each save
};

/// The options of one command. A command that lacks an option leaves its default.
struct Options {
  string command;                 // its name
  vector<string> operands;        // scene files or other operands, in order
  optional<string> output;        // folder
  vector<string> set;             // path=value
  optional<vector<string>> only;  // names of outputs, not empty
  optional<uint64_t> seed;
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
  optional<Shard> shard;
  bool accuracy = false;  // of check and run: estimate the error by more runs
  bool page = false;      // of explain: the whole format
  optional<double> at;    // s, of render: the time of a still
};

/// An option that a command has, by its name in the table of options (option_table.h).
struct OptionUse {
  string_view name;       // "--jobs"
  string_view help = {};  // its meaning for this command; empty: the table's text
};

/// One command: its operands, options and help. Every command has --color, --json, --quiet and --help too.
struct Command {
  string name;                 // "run"
  int (*run)(const Options&);  // gives the exit code; throws UsageError, Interrupted
  string line;                 // one sentence
  string examples;             // lines, first in the help
  string notes;                // lines, last in the help
  vector<OptionUse> options;   // in the order of the help
  string operand = "SCENE";    // name of the operands
  string operand_help = "scene files (YAML)";
  // Error for too few operands.
  string missing = "name a scene file: carom {} scenes/two_bowling_balls.yaml";
  size_t least = 1, most = numeric_limits<size_t>::max();  // number of operands
};

}  // namespace carom
