// Ranks and correlations are those of points: runs, or means of repeats.
// A rank correlation says nothing of its curve, so that it holds for measures of any scale.
#include "compare/findings.h"

#include <fmt/format.h>

#include "compare/scenarios.h"
#include "numerics/rank_correlation.h"
#include "std.h"

namespace carom {
namespace {

/// Differences of values below this share of them are rounding.
constexpr double rounding = 1e-12;

/// The greatest rank correlation by chance, of 19 in 20 cases without a relation (Kendall and Gibbons 1990, section
/// 4.7): its standard deviation for n points is 1 / sqrt(n - 1). Four points are in order by chance in 2 of 24 cases.
double chance(size_t points) {
  constexpr size_t least = 5;
  return points < least ? infinity : 1.96 / sqrt(double(points) - 1);
}

/// The values, of which those that differ by rounding alone are equal.
vector<double> without_rounding(vector<double> values) {
  vector<size_t> order;
  double scale = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!isfinite(values[i])) continue;
    order.push_back(i);
    scale = max(scale, std::abs(values[i]));
  }

  ranges::sort(order, [&](size_t a, size_t b) { return values[a] < values[b]; });
  for (size_t k = 1; k < order.size(); ++k)
    if (values[order[k]] - values[order[k - 1]] <= rounding * scale) values[order[k]] = values[order[k - 1]];
  return values;
}

void rank(MeasureFinding& finding, const vector<double>& values) {
  vector<size_t> order;
  for (size_t i = 0; i < values.size(); ++i)
    if (isfinite(values[i])) order.push_back(i);
  finding.points = order.size();
  if (order.empty()) return;

  ranges::stable_sort(order, [&](size_t a, size_t b) { return values[a] > values[b]; });
  const double high = values[order.front()], low = values[order.back()];
  finding.is_constant = high == low;
  finding.at_highest = size_t(ranges::count(values, high));
  finding.at_lowest = size_t(ranges::count(values, low));
  finding.bottom = size_t(ranges::find(values, low) - values.begin());
  finding.top = order.front();

  // The lowest first, those of equal values in the order of the runs.
  const size_t tops = min(order.size(), MeasureFinding::most_ranked);
  finding.highest.assign(order.begin(), order.begin() + ptrdiff_t(tops));
  order.erase(order.begin(), order.begin() + ptrdiff_t(tops));
  ranges::stable_sort(order,
                      [&](size_t a, size_t b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  order.resize(min(order.size(), MeasureFinding::most_ranked));
  finding.lowest = std::move(order);
}

double spread_of_repeats(const Outcomes& outcomes, size_t measure) {
  double squares = 0, count = 0;
  for (size_t i = 0; i < outcomes.points(); ++i) {
    const double sd = outcomes.spread(i, measure).sd();
    if (!isfinite(sd)) continue;
    squares += sd * sd;
    ++count;
  }
  return count > 0 ? sqrt(squares / count) : numeric_limits<double>::quiet_NaN();
}

void correlate(MeasureFinding& finding, const vector<double>& values, const vector<vector<double>>& parameters) {
  for (size_t k = 0; k < parameters.size(); ++k) {
    finding.correlations.push_back(parameters[k].empty() ? numeric_limits<double>::quiet_NaN()
                                                         : rank_correlation(parameters[k], values));
    const double strength = std::abs(finding.correlations[k]);
    if (!(strength > chance(finding.points))) continue;
    if (!finding.strongest || strength > std::abs(finding.correlations[*finding.strongest])) finding.strongest = k;
  }
}

}  // namespace

Variety variety_of(const Outcomes& outcomes) {
  const vector<size_t> parameters = outcomes.independent();
  if (parameters.empty()) return Variety::runs;
  if (parameters.size() == 1) return Variety::line;
  return parameters.size() == 2 && outcomes.is_grid(parameters[0], parameters[1]) ? Variety::plane : Variety::samples;
}

Findings findings_of(const Outcomes& outcomes, size_t measures, bool unrelated) {
  Findings findings;
  if (!unrelated) {
    findings.variety = variety_of(outcomes);
    findings.parameters = outcomes.independent();
  }

  // The values of each parameter, of which texts have no order.
  vector<vector<double>> parameters;
  for (const size_t p : findings.parameters) {
    parameters.emplace_back();
    for (size_t i = 0; outcomes.varied()[p].numeric && i < outcomes.points(); ++i)
      parameters.back().push_back(outcomes.value(i, p).number);
  }

  for (size_t k = 0; k < measures; ++k) {
    MeasureFinding& finding = findings.measures.emplace_back();
    finding.measure = k;
    vector<double> values;
    for (size_t i = 0; i < outcomes.points(); ++i) values.push_back(outcomes.spread(i, k).mean());
    values = without_rounding(std::move(values));
    rank(finding, values);
    finding.spread_of_repeats = spread_of_repeats(outcomes, k);
    correlate(finding, values, parameters);
  }
  return findings;
}

string varied_ranges(const ComparisonPlan& plan, const Outcomes& outcomes) {
  string text;
  for (const Varied& varied : outcomes.varied()) {
    if (varied.parameter == plan.seed || varied.values.empty()) continue;
    const Parameter& parameter = plan.parameters[varied.parameter];
    const auto value = [&](const Cell& cell) {
      return shown_value(cell) + (parameter.unit.empty() ? "" : " " + parameter.unit);
    };

    constexpr size_t most_listed = 4;
    text += (text.empty() ? "" : "; ") + parameter.path;
    if (varied.numeric && varied.values.size() > most_listed) {
      text += fmt::format(" from {} to {} ({} values)", value(varied.values.front()), value(varied.values.back()),
                          varied.values.size());
      continue;
    }
    for (size_t k = 0; k < min(varied.values.size(), most_listed); ++k)
      text += (k == 0 ? " " : ", ") + value(varied.values[k]);
    if (varied.values.size() > most_listed) text += fmt::format(" and {} more", varied.values.size() - most_listed);
  }

  if (plan.seed && outcomes.points() > 0) text += fmt::format("; up to {} seeds of each", outcomes.most_runs());
  return text;
}

vector<const MeasureFinding*> shown_findings(const Findings& findings, size_t most) {
  size_t all = 0;
  for (const MeasureFinding& finding : findings.measures) all = max(all, finding.points);

  vector<const MeasureFinding*> shown;
  for (const bool of_all : {true, false}) {
    if (!shown.empty() && findings.variety == Variety::runs) break;
    for (const MeasureFinding& finding : findings.measures)
      if (finding.points > 1 && !finding.is_constant && (finding.points == all) == of_all) shown.push_back(&finding);
  }

  ranges::sort(shown, {}, &MeasureFinding::measure);
  shown.resize(min(shown.size(), most));
  return shown;
}

}  // namespace carom
