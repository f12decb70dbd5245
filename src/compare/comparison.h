#pragma once
// Compares many runs: a table with a row for each run, and a workbook with charts.
// All data is read from the runs' folders, one at a time.
// Gathered parts of a sweep thus give the same bytes as an undivided sweep.

#include "compare/comparison_plan.h"
#include "files/output_file.h"
#include "std.h"

namespace carom {

struct ComparisonWatch {
  /// Called for each run. May throw.
  function<void()> stop_check = [] {};
  /// The number of runs read so far.
  function<void(size_t)> done = [](size_t) {};
  /// The number of doubtful runs, at the end.
  function<void(size_t)> doubtful = [](size_t) {};
};

/// Writes summary.csv, comparison.xlsx, index.html and, for repeats, repeats.csv into `place`, complete but with
/// temporary names. `run` returns run 0 to count - 1 and may be called repeatedly. A folder without a complete run but
/// with error.txt is a failed run. Throws MeasureError, and ExportError with a text that names what a folder lacks.
vector<unique_ptr<OutputFile>> write_comparison(const FilePlace& place, const ComparisonPlan& plan, size_t count,
                                                const function<ComparedRun(size_t)>& run,
                                                const ComparisonWatch& watch = {});

}  // namespace carom
