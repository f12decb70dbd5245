// Farthest points first (Gonzalez, "Clustering to Minimize the Maximum Intercluster Distance", 1985): corners of the
// grid, then its middle. Along a single parameter they are evenly spaced instead.
#include "compare/scenarios.h"

#include <fmt/format.h>

#include "std.h"

namespace carom {
namespace {

/// Points spread over the values of these parameters, ascending.
vector<size_t> spread_points(const Outcomes& outcomes, const vector<size_t>& parameters, size_t count) {
  const size_t all = outcomes.points();
  vector<size_t> chosen;
  if (all <= count || parameters.size() < 2) {
    // By the value of the parameter, or as they come.
    vector<size_t> order(all);
    for (size_t i = 0; i < all; ++i) order[i] = i;
    if (!parameters.empty()) {
      const Varied& varied = outcomes.varied()[parameters.front()];
      ranges::stable_sort(order, [&](size_t a, size_t b) { return varied.of_point[a] < varied.of_point[b]; });
    }

    for (size_t k = 0; k < min(all, count); ++k)
      chosen.push_back(order[all <= count ? k : k * (all - 1) / (count - 1)]);
    return chosen;
  }

  // The next one is always the farthest from those that are chosen.
  vector<double> nearest(all, infinity);  // squared distance to those chosen
  size_t next = 0;
  while (chosen.size() < count && nearest[next] > 0) {
    chosen.push_back(next);
    const size_t last = next;

    for (size_t i = 0; i < all; ++i) {
      double distance = 0;
      for (const size_t p : parameters) {
        const Varied& varied = outcomes.varied()[p];
        const double width = double(varied.values.size()) - 1;
        const double way = (double(varied.of_point[i]) - double(varied.of_point[last])) / width;
        distance += way * way;
      }

      nearest[i] = min(nearest[i], distance);
      if (nearest[i] > nearest[next] || i == 0) next = i;
    }
  }

  ranges::sort(chosen);
  return chosen;
}

}  // namespace

string shown_value(const Cell& cell) {
  return cell.is_number() ? fmt::format("{:.5g}", cell.number == 0 ? 0.0 : cell.number) : cell.text;
}

vector<string> short_names(const vector<string>& paths) {
  const auto tail = [](const string& path, size_t words) {
    size_t at = path.size();
    for (size_t k = 0; k < words && at != string::npos; ++k) at = at == 0 ? at : path.rfind('.', at - 1);
    return at == string::npos ? path : path.substr(at + 1);
  };

  vector<string> names;
  for (const string& path : paths) {
    // A coordinate alone says too little, and so does a default.
    const string last = tail(path, 1);
    size_t words = (last.size() == 1 || last == "default") && !path.starts_with("let.") ? 2 : 1;

    const auto is_taken = [&] {
      return any_of(paths,
                    [&](const string& other) { return other != path && tail(other, words) == tail(path, words); });
    };
    while (tail(path, words) != path && is_taken()) ++words;
    names.push_back(tail(path, words));
  }
  return names;
}

ChosenScenarios chosen_scenarios(const ComparisonPlan& plan, const Outcomes& outcomes,
                                 const vector<size_t>& point_of_run, bool unrelated) {
  const vector<size_t> parameters = unrelated ? vector<size_t>() : outcomes.independent();
  const vector<size_t> points = spread_points(outcomes, parameters, ChosenScenarios::most);

  vector<string> paths;
  for (const size_t p : parameters) paths.push_back(plan.parameters[p].path);
  const vector<string> names = short_names(paths);

  ChosenScenarios chosen;
  chosen.all = outcomes.points();
  vector<uint32_t> number(outcomes.points(), ChosenScenarios::none);
  for (const size_t point : points) {
    number[point] = uint32_t(chosen.names.size());

    // Named by its values.
    string name;
    for (size_t k = 0; k < parameters.size(); ++k) {
      const Varied& varied = outcomes.varied()[parameters[k]];
      const Cell& value = varied.values[varied.of_point[point]];
      const string& unit = plan.parameters[parameters[k]].unit;
      name +=
          fmt::format("{}{} = {}{}{}", k == 0 ? "" : ", ", names[k], shown_value(value), unit.empty() ? "" : " ", unit);
    }
    chosen.names.push_back(name.empty() ? string(outcomes.id(point)) : name);
  }

  for (const size_t point : point_of_run)
    chosen.of_run.push_back(point == Outcomes::no_point ? ChosenScenarios::none : number[point]);
  return chosen;
}

}  // namespace carom
