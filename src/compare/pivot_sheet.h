#pragma once
// A measure by two parameters: the mean of the runs with both values. Small tables use formulas.

#include "compare/outcomes.h"
#include "std.h"

namespace carom {

/// The two parameters of the table: those of the first chart that has two, else the first two that vary independently.
/// None: fewer than two vary.
optional<pair<size_t, size_t>> pivot_parameters(const ComparisonPlan& plan, const Outcomes& outcomes);

/// The place of the data on the sheet Summary.
struct SummaryPlace {
  vector<size_t> parameters, measures;  // columns, by parameter and by measure
  size_t first_row, rows;               // from 0; no rows: no formulas
};

void write_pivot(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const Outcomes& outcomes, pair<size_t, size_t> parameters, const SummaryPlace& summary);

}  // namespace carom
