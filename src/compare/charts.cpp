// Chooses the default charts, and collects the points of each chart in rows with a common x.
// Without a choice of the user, x is the first independent parameter, and the second one makes the lines.
#include "compare/charts.h"

#include <fmt/format.h>

#include "compare/heat_map.h"
#include "compare/scenarios.h"
#include "std.h"

namespace carom {
namespace {

constexpr size_t most_default_charts = 6, most_default_lines = 8, most_lines = 24;
/// Charts of samples: one for each pair of a measure and a parameter.
constexpr size_t most_scatters = 12;
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

/// Each measure over each parameter with numbers, as many as there may be charts: the first measure over all, the
/// others over those that matter most.
vector<Chart> scatters(const ComparisonPlan& plan, const vector<Measure>& measures, const Outcomes& outcomes,
                       const Findings& findings, const vector<const MeasureFinding*>& shown) {
  vector<Chart> charts;
  for (size_t k = 0; k < shown.size(); ++k) {
    const vector<double>& correlations = shown[k]->correlations;
    const auto strength = [&](size_t place) {
      return isfinite(correlations[place]) ? std::abs(correlations[place]) : 0.0;
    };
    vector<size_t> places;
    for (size_t place = 0; place < findings.parameters.size(); ++place)
      if (outcomes.varied()[findings.parameters[place]].numeric) places.push_back(place);
    ranges::stable_sort(places, [&](size_t a, size_t b) { return strength(a) > strength(b); });

    const size_t room = (most_scatters - min(charts.size(), most_scatters)) / (shown.size() - k);
    const size_t most = k == 0 ? max(room, places.size()) : max<size_t>(room, 1);
    for (size_t i = 0; i < min(most, places.size()); ++i)
      charts.push_back({plan.parameters[findings.parameters[places[i]]].path, measures[shown[k]->measure].name, ""});
  }
  return charts;
}

}  // namespace

vector<Chart> chosen_charts(const ComparisonPlan& plan, const vector<Measure>& measures, const Outcomes& outcomes,
                            const Findings& findings) {
  if (!plan.charts.empty()) return plan.charts;
  const vector<const MeasureFinding*> shown = shown_findings(findings, most_default_charts);
  if (findings.variety == Variety::samples) return scatters(plan, measures, outcomes, findings, shown);

  // Of two parameters the one with fewer values makes the lines.
  vector<size_t> parameters = findings.parameters;
  const auto values = [&](size_t p) { return outcomes.varied()[p].values.size(); };
  if (parameters.size() > 1 && values(parameters[1]) > most_default_lines &&
      values(parameters[0]) <= most_default_lines)
    std::swap(parameters[0], parameters[1]);
  const string x = parameters.empty() ? "" : plan.parameters[parameters[0]].path;
  const string by = parameters.size() < 2 ? "" : plan.parameters[parameters[1]].path;

  vector<Chart> charts;
  for (const MeasureFinding* finding : shown) charts.push_back({x, measures[finding->measure].name, by});
  return charts;
}

ChartData chart_data(const Chart& chart, const ComparisonPlan& plan, const vector<Measure>& measures,
                     const Outcomes& outcomes, Variety variety) {
  const XAxis axis = x_axis(chart, plan, measures, outcomes);
  const size_t y = find_measure(measures, chart.y).value_or(0);
  const auto by = chart.by.empty() ? nullopt : find_parameter(plan, chart.by);
  const Varied* lines = by && by != plan.seed ? &outcomes.varied()[*by] : nullptr;

  ChartData data;
  data.x_label = axis.label;
  data.y_label = label_of(chart.y);
  data.title = fmt::format("{} by {}", data.y_label, axis.label);
  data.numeric = axis.numeric;

  // Evenly spaced values of the lines, if there are many.
  const size_t all = lines == nullptr ? 1 : lines->values.size();
  const vector<size_t> chosen = evenly_spaced(all, plan.charts.empty() ? most_default_lines : most_lines);
  vector<size_t> line_of_value(all, chosen.size());
  data.lines.resize(chosen.size());
  for (size_t line = 0; line < chosen.size(); ++line) {
    line_of_value[chosen[line]] = line;
    if (lines != nullptr)
      data.lines[line].name =
          name_of_value(plan.parameters[lines->parameter], shown_value(lines->values[chosen[line]]));
  }
  if (all > chosen.size()) data.note = fmt::format("{} of {} values of {}", chosen.size(), all, chart.by);

  // Make a row for each x, and several rows if a line has several points there.
  const auto line_of = [&](size_t i) { return line_of_value[lines == nullptr ? 0 : lines->of_point[i]]; };

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

  data.joined = axis.chosen && variety != Variety::samples;
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
