#pragma once
// Which charts a comparison shows, and what is in them.
#include <string>
#include <vector>

#include "compare/outcomes.h"

namespace carom {

struct ChartLine {
  std::string name;            // "balls.red.position.z = 0.025 m"; empty: the only line
  std::vector<double> y;       // by row of ChartData::x; not a number: the line has no such point
  std::vector<double> spread;  // the same, standard deviations; empty: no repeats
};

struct ChartData {
  std::string title, x_label, y_label;
  std::vector<Cell> x;
  std::vector<ChartLine> lines;
  bool numeric = true;  // x is
  bool joined = true;   // a line goes through its points: no two have the same x, and x was chosen
  std::string note;     // what is left out; empty: nothing
};

/// The plan's charts; if it has none, those that what varies suggests.
std::vector<Chart> chosen_charts(const ComparisonPlan& plan, const std::vector<Measure>& measures,
                                 const Outcomes& outcomes);

ChartData chart_data(const Chart& chart, const ComparisonPlan& plan, const std::vector<Measure>& measures,
                     const Outcomes& outcomes);

/// "balls.red.position.z (m)".
std::string label_of(const Parameter& parameter);

/// "balls.red.position.z = 0.025 m".
std::string name_of_value(const Parameter& parameter, const std::string& value);

/// A parameter's number in the plan; none if it is not there.
std::optional<std::size_t> find_parameter(const ComparisonPlan& plan, std::string_view path);

}  // namespace carom
