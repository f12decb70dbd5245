#include "compare/heat_map.h"

#include "std.h"

namespace carom {
namespace {

/// By index of value: its place in `chosen`, or none.
vector<size_t> places_in(const vector<size_t>& chosen, size_t values) {
  vector<size_t> places(values, chosen.size());
  for (size_t k = 0; k < chosen.size(); ++k) places[chosen[k]] = k;
  return places;
}

}  // namespace

vector<size_t> evenly_spaced(size_t values, size_t most) {
  const size_t count = min(values, most);
  vector<size_t> chosen;
  for (size_t k = 0; k < count; ++k) chosen.push_back(count < 2 ? 0 : k * (values - 1) / (count - 1));
  return chosen;
}

optional<pair<size_t, size_t>> heat_map_parameters(const ComparisonPlan& plan, const Outcomes& outcomes) {
  const auto varies = [&](optional<size_t> p) {
    return p && p != plan.seed && outcomes.varied()[*p].values.size() > 1;
  };
  for (const Chart& chart : plan.charts) {
    const auto x = find_parameter(plan, chart.x), by = find_parameter(plan, chart.by);
    if (varies(x) && varies(by) && x != by) return pair(*x, *by);
  }

  const vector<size_t> independent = outcomes.independent();
  if (independent.size() < 2 || !outcomes.is_grid(independent[0], independent[1])) return nullopt;
  return pair(independent[0], independent[1]);
}

HeatMap heat_map(const Outcomes& outcomes, pair<size_t, size_t> parameters, size_t measure, size_t most_values) {
  const Varied &down = outcomes.varied()[parameters.first], &across = outcomes.varied()[parameters.second];
  HeatMap map{parameters.first,
              parameters.second,
              evenly_spaced(down.values.size(), most_values),
              evenly_spaced(across.values.size(), most_values),
              {}};
  const size_t height = map.rows.size(), width = map.columns.size();
  const vector<size_t> row_of = places_in(map.rows, down.values.size());
  const vector<size_t> column_of = places_in(map.columns, across.values.size());

  // A point counts as often as it has runs.
  vector<double> sums(height * width), counts(height * width);
  for (size_t i = 0; i < outcomes.points(); ++i) {
    const size_t row = row_of[down.of_point[i]], column = column_of[across.of_point[i]];
    if (row == height || column == width) continue;
    const Spread spread = outcomes.spread(i, measure);
    if (spread.count() == 0) continue;
    sums[row * width + column] += spread.mean() * double(spread.count());
    counts[row * width + column] += double(spread.count());
  }

  for (size_t k = 0; k < sums.size(); ++k)
    map.means.push_back(counts[k] > 0 ? sums[k] / counts[k] : numeric_limits<double>::quiet_NaN());
  return map;
}

}  // namespace carom
