// Chooses the default charts, and collects the points of each chart in rows with a common x.
// Without a choice of the user, x is the first independent parameter, and the second one makes the lines.
#include "compare/charts.h"

#include <fmt/format.h>

#include "std.h"

namespace carom {
namespace {

constexpr size_t most_default_charts = 6, most_default_lines = 10, most_lines = 24;
/// Points of a chart, which has fewer pixels than that.
constexpr size_t most_charted = 2000;

optional<size_t> find_measure(const vector<Measure>& measures, string_view name) {
  for (size_t k = 0; k < measures.size(); ++k)
    if (measures[k].name == name) return k;
  return nullopt;
}

/// The x axis: a number or a text for each point.
struct XAxis {
  string label;
  // `chosen`: a parameter and not a measure.
  bool numeric = true, chosen = true;
  function<Cell(size_t)> of_point;
};

XAxis x_axis(const Chart& chart, const ComparisonPlan& plan, const vector<Measure>& measures,
             const Outcomes& outcomes) {
  XAxis axis;
  const auto parameter = find_parameter(plan, chart.x);
  const auto measure = find_measure(measures, chart.x);

  if (parameter && parameter != plan.seed) {
    const Varied& varied = outcomes.varied()[*parameter];
    axis.label = label_of(plan.parameters[*parameter]);
    axis.numeric = varied.numeric;
    axis.of_point = [&varied](size_t i) { return varied.values[varied.of_point[i]]; };
  } else if (measure) {
    axis.label = label_of(chart.x);
    axis.chosen = false;
    axis.of_point = [&outcomes, m = *measure](size_t i) { return Cell{{}, outcomes.spread(i, m).mean()}; };
  } else {
    axis.label = "run";
    axis.numeric = false;
    axis.of_point = [&outcomes](size_t i) { return Cell{string(outcomes.id(i))}; };
  }

  return axis;
}

}  // namespace

vector<Chart> chosen_charts(const ComparisonPlan& plan, const vector<Measure>& measures, const Outcomes& outcomes) {
  if (!plan.charts.empty()) return plan.charts;

  vector<size_t> independent = outcomes.independent();
  const auto values = [&](size_t p) { return outcomes.varied()[p].values.size(); };
  string x, by;
  if (!independent.empty()) {
    // The parameter with few values makes the lines.
    if (independent.size() > 1 && values(independent[1]) > most_default_lines &&
        values(independent[0]) <= most_default_lines)
      std::swap(independent[0], independent[1]);
    x = plan.parameters[independent[0]].path;
    if (independent.size() > 1 && values(independent[1]) <= most_default_lines)
      by = plan.parameters[independent[1]].path;
  }

  vector<Chart> charts;
  for (size_t k = 0; k < measures.size() && k < most_default_charts; ++k) charts.push_back({x, measures[k].name, by});
  return charts;
}

ChartData chart_data(const Chart& chart, const ComparisonPlan& plan, const vector<Measure>& measures,
                     const Outcomes& outcomes) {
  const XAxis axis = x_axis(chart, plan, measures, outcomes);
  const size_t y = find_measure(measures, chart.y).value_or(0);
  const auto by = chart.by.empty() ? nullopt : find_parameter(plan, chart.by);
  const Varied* lines = by && by != plan.seed ? &outcomes.varied()[*by] : nullptr;

  ChartData data;
  data.x_label = axis.label;
  data.y_label = label_of(chart.y);
  data.title = fmt::format("{} by {}", data.y_label, axis.label);
  data.numeric = axis.numeric;

  const size_t all = lines == nullptr ? 1 : lines->values.size();
  data.lines.resize(min(all, most_lines));
  if (all > most_lines) data.note = fmt::format("{} of {} values of {}", most_lines, all, chart.by);
  for (size_t line = 0; lines != nullptr && line < data.lines.size(); ++line)
    data.lines[line].name = name_of_value(plan.parameters[*by], lines->values[line].text);

  // Make a row for each x, and several rows if a line has several points there.
  const auto line_of = [&](size_t i) -> size_t { return lines == nullptr ? 0 : lines->of_point[i]; };

  vector<size_t> points_of_line(data.lines.size());
  size_t shown = 0;
  for (size_t i = 0; i < outcomes.points(); ++i) shown += line_of(i) < data.lines.size() ? 1 : 0;
  const size_t every = 1 + (max<size_t>(shown, 1) - 1) / most_charted;
  if (every * outcomes.every() > 1)
    data.note += fmt::format("{}one of {} runs", data.note.empty() ? "" : ", ", every * outcomes.every());

  // x, or the order of its text; the number of earlier points with it.
  using Row = pair<pair<double, size_t>, size_t>;
  map<Row, vector<pair<size_t, size_t>>> rows;  // line and point
  map<string, size_t> texts;
  map<pair<size_t, pair<double, size_t>>, size_t> seen;

  for (size_t i = 0; i < outcomes.points(); ++i) {
    const size_t line = line_of(i);
    // Each line is thinned separately, so that no line is lost.
    if (line >= data.lines.size() || points_of_line[line]++ % every != 0) continue;

    const Cell x = axis.of_point(i);
    if (axis.numeric && !x.is_number()) continue;
    const pair<double, size_t> key =
        axis.numeric ? pair(x.number, size_t{0}) : pair(0.0, texts.emplace(x.text, i).first->second);
    rows[{key, seen[{line, key}]++}].emplace_back(line, i);
  }

  // A line has no value where it has no point.
  for (ChartLine& line : data.lines) {
    line.y.assign(rows.size(), std::nan(""));
    if (plan.seed) line.spread = line.y;
  }

  data.joined = axis.chosen;
  for (const auto& [key, points] : rows) {
    for (const auto& [line, point] : points) {
      const Spread spread = outcomes.spread(point, y);
      data.lines[line].y[data.x.size()] = spread.mean();
      if (plan.seed) data.lines[line].spread[data.x.size()] = spread.sd();
    }
    data.x.push_back(axis.of_point(points.front().second));
    data.joined = data.joined && key.second == 0;
  }
  return data;
}

}  // namespace carom
