#pragma once
// The sheet with what varies and with the common values of all runs.

#include "compare/outcomes.h"
#include "scene/scene_values.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

/// A value in which scenes differ. Empty cells: the scene lacks it.
struct Difference {
  size_t parameter = 0;   // its index in the plan
  vector<string> values;  // by run
};

/// If scenes have little in common: the values of the first few runs.
struct DifferenceList {
  static constexpr size_t runs_shown = 8;
  vector<string> runs;      // ids
  vector<Difference> rows;  // what matters most comes first
  size_t all_runs = 0;      // of the sheet, also those without a column here
};

class ParameterSheet {
 public:
  /// `unrelated`: most parameters exist in some scenes only.
  ParameterSheet(Worksheet& sheet, const ComparisonPlan& plan, bool unrelated);
  void add(const ComparedRun& run);
  void finish(const Outcomes& outcomes, const vector<SceneValue>& common);

  /// Valid after finish(). Empty unless the runs are unrelated.
  const DifferenceList& differences() const { return differences_; }

 private:
  size_t write_ranges(const Outcomes& outcomes, size_t row);
  size_t write_differences(size_t row);

  Worksheet& sheet_;
  const ComparisonPlan& plan_;
  bool unrelated_;
  DifferenceList differences_;
};

}  // namespace carom
