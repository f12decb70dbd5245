#pragma once
// What is compared: runs, the values in which they differ, measures and charts.

#include "files/csv_dialect.h"
#include "run/measure.h"
#include "std.h"

namespace carom {

/// The names of the files of a comparison. The first one is that of a run, too.
inline constexpr const char* summary_name = "summary.csv";
inline constexpr const char* repeats_name = "repeats.csv";
inline constexpr const char* workbook_name = "comparison.xlsx";

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
  CsvDialect dialect{};  // of its tables
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

/// "balls.red.position.z (m)".
string label_of(const Parameter& parameter);

/// "balls.red.position.z = 0.025 m".
string name_of_value(const Parameter& parameter, const string& value);

/// The index of a parameter in the plan, or none.
optional<size_t> find_parameter(const ComparisonPlan& plan, string_view path);

}  // namespace carom
