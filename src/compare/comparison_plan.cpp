// Charts and measures are checked before the first run is read.
#include "compare/comparison_plan.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"

namespace carom {
namespace {

/// The default measures.
constexpr const char* usual_measures[] = {"energy_lost_J", "collisions", "max_speed_m_per_s"};

}  // namespace

optional<size_t> find_parameter(const ComparisonPlan& plan, string_view path) {
  for (size_t p = 0; p < plan.parameters.size(); ++p)
    if (plan.parameters[p].path == path) return p;
  return nullopt;
}

string label_of(const Parameter& parameter) {
  return parameter.unit.empty() ? parameter.path : fmt::format("{} ({})", parameter.path, parameter.unit);
}

string name_of_value(const Parameter& parameter, const string& value) {
  return fmt::format("{} = {}{}{}", parameter.path, value, parameter.unit.empty() ? "" : " ", parameter.unit);
}

vector<Measure> measures_of(const ComparisonPlan& plan) {
  vector<Measure> measures;
  const auto add = [&](string_view name) {
    const bool known = any_of(measures, [&](const Measure& measure) { return measure.name == name; });
    if (!known) measures.push_back(parse_measure(name, plan.own));
  };

  for (const string& name : plan.measures) add(name);
  for (const Chart& chart : plan.charts) {
    add(chart.y);
    if (!find_parameter(plan, chart.x)) add(chart.x);
  }

  // Scenes that define other measures than the first one have the usual ones in common.
  const bool shared = none_of(plan.parameters, [](const Parameter& p) { return p.path.starts_with("measures."); });
  const auto add_usual = [&] {
    for (const char* name : usual_measures) add(name);
  };
  if (measures.empty() && !shared) add_usual();
  for (const string& name : plan.own) add(name);
  if (measures.empty()) add_usual();
  return measures;
}

void check_charts(const ComparisonPlan& plan) {
  vector<string_view> paths;
  for (const Parameter& parameter : plan.parameters) paths.push_back(parameter.path);

  const auto refuse = [&](const string& name, const char* what) {
    const string near = nearest(name, paths);
    string remedy;
    if (!near.empty()) remedy = fmt::format("; did you mean {}?", in_backticks(near));
    if (near.empty() && !paths.empty()) remedy = fmt::format("; the varied paths are {}", joined(paths, ", "));
    throw MeasureError(fmt::format("a chart's {} {}{}", in_backticks(name), what, remedy));
  };

  for (const Chart& chart : plan.charts) {
    if (!chart.by.empty() && !find_parameter(plan, chart.by)) refuse(chart.by, "is not varied");
    if (find_parameter(plan, chart.x)) continue;
    try {
      parse_measure(chart.x, plan.own);
    } catch (const MeasureError&) {
      refuse(chart.x, "is neither varied nor a measure");
    }
  }

  measures_of(plan);
}

}  // namespace carom
