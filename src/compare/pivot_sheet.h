#pragma once
// A measure by two parameters: the mean of the runs with both values. Small tables use formulas.

#include "compare/heat_map.h"
#include "compare/outcomes.h"
#include "std.h"

namespace carom {

/// The place of the data on the sheet Summary.
struct SummaryPlace {
  vector<size_t> parameters, measures;  // columns, by parameter and by measure
  size_t first_row, rows;               // from 0; no rows: no formulas
};

/// The heat maps of the first measures, as large as a sheet allows.
void write_pivot(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const Outcomes& outcomes, pair<size_t, size_t> parameters, const SummaryPlace& summary);

/// A heat map with its heads, cells and colours. The heads of rows and columns are at these places, its means right and
/// below.
struct HeatMapPlace {
  size_t head_row, first_column;
  size_t columns_of_head = 1;  // of the heads of rows
  bool is_small = false;       // whether texts shrink to their cells
  size_t columns_of_cell = 1;

  /// Whether the heads of columns are turned.
  bool is_turned() const { return is_small && columns_of_cell == 1; }
};
/// Writes means as formulas on the sheet Summary if `summary` has rows. Returns the row below it.
size_t write_heat_map(Worksheet& sheet, const ComparisonPlan& plan, const Outcomes& outcomes, const HeatMap& map,
                      size_t measure, const HeatMapPlace& place, const SummaryPlace& summary);

}  // namespace carom
