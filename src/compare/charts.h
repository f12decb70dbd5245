#pragma once
// The charts of a comparison and their data.

#include "compare/findings.h"
#include "compare/outcomes.h"
#include "std.h"

namespace carom {

struct ChartLine {
  string name;  // "balls.red.position.z = 0.025 m"; empty: the only line
  /// By row of ChartData::x. NaN: the line has no such point.
  vector<double> y;
  /// Likewise, standard deviations. Empty: no repeats.
  vector<double> spread;
};

struct ChartData {
  string title, x_label, y_label;
  vector<Cell> x;
  vector<ChartLine> lines;
  bool numeric = true;  // whether x is a number
  /// Whether a line joins its points. It does if no two have the same x, and x is a parameter, not of samples.
  bool joined = true;
  /// Describes what is left out. Empty: nothing.
  string note;
};

/// The plan's charts. If it has none: each measure that differs over one parameter, with a line for each value of a
/// second one; of samples over each parameter, the strongest first; of unrelated runs a bar for each run.
vector<Chart> chosen_charts(const ComparisonPlan& plan, const vector<Measure>& measures, const Outcomes& outcomes,
                            const Findings& findings);

ChartData chart_data(const Chart& chart, const ComparisonPlan& plan, const vector<Measure>& measures,
                     const Outcomes& outcomes, Variety variety);

}  // namespace carom
