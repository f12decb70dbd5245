#pragma once
// The charts of a comparison's page: plots by gnuplot, and tables whose cells are coloured or hold bars.

#include "compare/charts.h"
#include "compare/heat_map.h"
#include "compare/run_table.h"
#include "export/page.h"
#include "run/measure.h"
#include "std.h"

namespace carom {

/// A chart along numbers, as a plot.
Plot plot_of(const ChartData& chart);

/// A chart along texts: a row for each, with bars.
string bar_table(const ChartData& chart);

/// A measure by two parameters: a cell for each two values, coloured by the mean of its runs. `runs`: links cells of
/// one run to its row.
string heat_table(const HeatMap& map, const ComparisonPlan& plan, const Measure& measure, const Outcomes& outcomes,
                  const RunTable& runs);

/// The rules of colours for cells of heat maps and correlations.
string heat_style();

/// The class of a cell's colour at `part` of the range, 0 to 1.
string heat_class(double part);

}  // namespace carom
