#pragma once
// Compares many runs: a table with a row for each run, and a workbook with charts.
// All data is read from the runs' folders, one at a time.
// Gathered parts of a sweep thus give the same bytes as an undivided sweep.

#include "files/output_file.h"
#include "run/measure.h"
#include "std.h"

namespace carom {

/// A value of the scene that differs between runs.
struct Parameter {
  string path;  // "balls.red.position.z"
  string unit;  // "m"; empty: no unit, or text
};

/// One chart of the workbook.
struct Chart {
  string x;  // a parameter, or a measure
  string y;  // a measure
  /// A parameter, with a line for each of its values. Empty: one line.
  string by;
};

struct ComparisonPlan {
  string title;
  vector<Parameter> parameters;
  vector<string> measures;  // names accepted by parse_measure
  vector<Chart> charts;     // empty: default charts of what varies
  /// The parameter that distinguishes repeats, if there are repeats.
  optional<size_t> seed;
  /// The names of the measures that the runs' scenes define. All of them are columns.
  vector<string> own{};
  /// Whether the workbook has a sheet with the first collisions of each run.
  bool collisions = false;
};

struct ComparedRun {
  string id;
  string folder;
  vector<string> values;  // of the parameters, as text
  /// Whether the run failed, whatever its folder holds.
  bool failed = false;
};

/// All measures of the plan and of its charts, each once. Throws MeasureError.
vector<Measure> measures_of(const ComparisonPlan& plan);

/// Throws MeasureError if a chart names neither a parameter nor a measure.
void check_charts(const ComparisonPlan& plan);

struct ComparisonWatch {
  /// Called for each run. May throw.
  function<void()> stop_check = [] {};
  /// The number of runs read so far.
  function<void(size_t)> done = [](size_t) {};
  /// The number of doubtful runs, at the end.
  function<void(size_t)> doubtful = [](size_t) {};
};

/// The names of the files of a comparison.
inline constexpr const char* summary_name = "summary.csv";
inline constexpr const char* repeats_name = "repeats.csv";
inline constexpr const char* workbook_name = "comparison.xlsx";

/// Writes summary.csv, comparison.xlsx and, for repeats, repeats.csv into `place`, complete but with temporary names.
/// `run` returns run 0 to count - 1 and may be called repeatedly.
/// A folder without a complete run but with error.txt is a failed run.
/// Throws MeasureError, and ExportError with a text that names what a folder lacks.
vector<unique_ptr<OutputFile>> write_comparison(const FilePlace& place, const ComparisonPlan& plan, size_t count,
                                                const function<ComparedRun(size_t)>& run,
                                                const ComparisonWatch& watch = {});

}  // namespace carom
