#pragma once
// The charts of a comparison and their data.
#include <string>
#include <vector>

#include "compare/outcomes.h"

namespace carom {

struct ChartLine {
  std::string name;  // "balls.red.position.z = 0.025 m"; empty: the only line
  /// By row of ChartData::x. NaN: the line has no such point.
  std::vector<double> y;
  /// Likewise, standard deviations. Empty: no repeats.
  std::vector<double> spread;
};

struct ChartData {
  std::string title, x_label, y_label;
  std::vector<Cell> x;
  std::vector<ChartLine> lines;
  bool numeric = true;  // whether x is a number
  /// Whether a line joins its points. It does if no two have the same x, and x is a parameter.
  bool joined = true;
  /// Describes what is left out. Empty: nothing.
  std::string note;
};

/// The plan's charts, or, if it has none, default charts of what varies.
std::vector<Chart> chosen_charts(const ComparisonPlan& plan, const std::vector<Measure>& measures,
                                 const Outcomes& outcomes);

ChartData chart_data(const Chart& chart, const ComparisonPlan& plan, const std::vector<Measure>& measures,
                     const Outcomes& outcomes);

/// "balls.red.position.z (m)".
std::string label_of(const Parameter& parameter);

/// "balls.red.position.z = 0.025 m".
std::string name_of_value(const Parameter& parameter, const std::string& value);

/// The index of a parameter in the plan, or none.
std::optional<std::size_t> find_parameter(const ComparisonPlan& plan, std::string_view path);

}  // namespace carom
