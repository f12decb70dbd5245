#pragma once
// index.html of a comparison: what was varied, which runs are highest and lowest, what decides, and a table of all
// runs. All of it is readable without scripts, which only sort, filter and put runs side by side.

#include "compare/findings.h"
#include "compare/parameter_sheet.h"
#include "compare/run_table.h"
#include "scene/scene_values.h"
#include "std.h"

namespace carom {

struct RunCounts {
  size_t all = 0, failed = 0, doubtful = 0;
};

/// What a page shows. All must outlive comparison_page().
struct PageContent {
  const ComparisonPlan& plan;
  const vector<Measure>& measures;
  const Outcomes& outcomes;
  const Findings& findings;
  const RunTable& runs;
  /// Of unrelated runs. Empty: they are related.
  const DifferenceList& differences;
  const vector<SceneValue>& common;  // values that all scenes share
  RunCounts count;
};

/// The page. Without gnuplot its charts are a sentence that names the remedy. Throws ExportError.
string comparison_page(const PageContent& content);

}  // namespace carom
