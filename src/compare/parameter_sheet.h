#pragma once
// The sheet with the varied values of each run, and the common values of all runs.
#include <vector>

#include "compare/outcomes.h"
#include "compare/workbook.h"
#include "scene/scene_values.h"

namespace carom {

class ParameterSheet {
 public:
  static constexpr std::size_t most = 2000;  // runs

  ParameterSheet(Worksheet& sheet, const ComparisonPlan& plan);
  void add(const ComparedRun& run);
  void finish(const Outcomes& outcomes, const std::vector<SceneValue>& common);

 private:
  std::size_t write_varied(const Outcomes& outcomes, std::size_t row, std::size_t first);

  Worksheet& sheet_;
  const ComparisonPlan& plan_;
  std::size_t runs_ = 0;
};

}  // namespace carom
