#pragma once
// The sheet with what varies and with the common values of all runs.
#include <string>
#include <vector>

#include "compare/outcomes.h"
#include "compare/workbook.h"
#include "scene/scene_values.h"

namespace carom {

/// A value in which scenes differ. Empty cells: the scene lacks it.
struct Difference {
  std::size_t parameter = 0;        // its index in the plan
  std::vector<std::string> values;  // by run
};

/// The values of the first few runs whose scenes have little in common.
struct DifferenceList {
  static constexpr std::size_t most_runs = 8;
  std::vector<std::string> runs;  // ids
  std::vector<Difference> rows;   // what matters most comes first
  std::size_t all_runs = 0;
};

class ParameterSheet {
 public:
  /// `unrelated`: see Variation.
  ParameterSheet(Worksheet& sheet, const ComparisonPlan& plan, bool unrelated);
  void add(const ComparedRun& run);
  void finish(const Outcomes& outcomes, const std::vector<SceneValue>& common);

  /// Valid after finish(). Empty unless the runs are unrelated.
  const DifferenceList& differences() const { return differences_; }

 private:
  std::size_t write_ranges(const Outcomes& outcomes, std::size_t row);
  std::size_t write_differences(std::size_t row);

  Worksheet& sheet_;
  const ComparisonPlan& plan_;
  bool unrelated_;
  DifferenceList differences_;
};

}  // namespace carom
