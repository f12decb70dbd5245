#pragma once
// Many runs side by side: a table with a row a run, and a workbook with charts. All is read from the runs' folders, one
// at a time, so that shards that were gathered give the bytes of a sweep that was never divided.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "run/measure.h"

namespace carom {

/// A value of the scene in which the runs differ.
struct Parameter {
  std::string path;  // "balls.red.position.z"
  std::string unit;  // "m"; empty: none, or text
};

/// One chart of the workbook.
struct Chart {
  std::string x;   // a parameter, or a measure
  std::string y;   // a measure
  std::string by;  // a parameter, a line for each of its values; empty: one line
};

struct ComparisonPlan {
  std::string title;
  std::vector<Parameter> parameters;
  std::vector<std::string> measures;  // names that parse_measure reads
  std::vector<Chart> charts;          // none: chosen by what varies
  std::optional<std::size_t> seed;    // the parameter that tells repeats apart, if there are repeats
};

struct ComparedRun {
  std::string id;
  std::string folder;
  std::vector<std::string> values;  // of the parameters, as text
  bool failed = false;              // known to have failed, whatever its folder holds
};

/// All measures that the plan wants of a run: its own and its charts', each once. Throws MeasureError.
std::vector<Measure> measures_of(const ComparisonPlan& plan);

/// Throws MeasureError where a chart names what is no parameter and no measure.
void check_charts(const ComparisonPlan& plan);

struct ComparisonWatch {
  std::function<void()> look = [] {};                              // called for each run; may throw
  std::function<void(std::size_t)> done = [](std::size_t) {};      // so many runs are read
  std::function<void(std::size_t)> doubtful = [](std::size_t) {};  // so many of them are doubtful: at the end
};

/// What a comparison writes.
inline constexpr const char* summary_name = "summary.csv";
inline constexpr const char* repeats_name = "repeats.csv";
inline constexpr const char* workbook_name = "comparison.xlsx";

/// Writes summary.csv, comparison.xlsx and, of repeats, repeats.csv into `place`, complete but without their names yet.
/// `run` gives run 0 to count - 1, whenever it is asked. A folder without a whole run but with error.txt is a failed
/// run. Throws ExportError, which says what a folder lacks, and MeasureError.
std::vector<std::unique_ptr<OutputFile>> write_comparison(const FilePlace& place, const ComparisonPlan& plan,
                                                          std::size_t count,
                                                          const std::function<ComparedRun(std::size_t)>& run,
                                                          const ComparisonWatch& watch = {});

}  // namespace carom
