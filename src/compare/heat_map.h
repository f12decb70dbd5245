#pragma once
// A measure by two parameters: the mean of the runs with both values.

#include "compare/outcomes.h"
#include "std.h"

namespace carom {

struct HeatMap {
  /// The parameters' indices in the plan.
  size_t down = 0, across = 0;
  /// Their values in rows and columns: indices of Varied::values.
  vector<size_t> rows, columns;
  /// By row, then column. NaN: no run has both values.
  vector<double> means;

  double mean(size_t row, size_t column) const { return means[row * columns.size() + column]; }
};

/// Indices of at most `most` of so many values, the first and the last among them.
vector<size_t> evenly_spaced(size_t values, size_t most);

/// The two parameters of a heat map: those of the first chart that has two, else the first two that vary independently,
/// if their grid is mostly filled. None: there are no such two.
optional<pair<size_t, size_t>> heat_map_parameters(const ComparisonPlan& plan, const Outcomes& outcomes);

/// `most_values`: of each parameter. Of more, evenly spaced ones are chosen, the first and the last among them.
HeatMap heat_map(const Outcomes& outcomes, pair<size_t, size_t> parameters, size_t measure, size_t most_values);

}  // namespace carom
