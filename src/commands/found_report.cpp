#include "commands/found_report.h"

#include <fmt/format.h>

#include "commands/text.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/printable.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t most_lines = 5;

string number_text(double value) {
  return fmt::format("{:.5g}", value == 0 ? 0.0 : value);
}

/// "r0540 (let.angle = 73, let.speed = 9), and 3 more".
string text_of(const FoundRun& run) {
  string values;
  for (const auto& [path, value] : run.values)
    values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", printable(path), printable(value));
  return printable(run.id) + (values.empty() ? "" : fmt::format(" ({})", values)) +
         (run.others > 0 ? fmt::format(", and {} more", grouped(run.others)) : "");
}

/// "2 (r0540)", "0 (r0098 and 248 more)".
string short_text_of(const FoundRun& run) {
  return fmt::format("{} ({}{})", number_text(run.value), printable(run.id),
                     run.others > 0 ? fmt::format(" and {} more", grouped(run.others)) : "");
}

Json run_json(const FoundRun& run) {
  Json values = Json::object();
  for (const auto& [path, value] : run.values) values[path] = value;
  return {{"run", run.id},
          {"value", run.value},
          {"repeats", run.repeats},
          {"others", run.others},
          {"values", std::move(values)}};
}

}  // namespace

void describe(Block& block, const vector<FoundMeasure>& found) {
  size_t lines = 0;
  for (const FoundMeasure& one : found) {
    if (lines == most_lines) break;
    if (!(one.lowest.value < one.highest.value)) continue;
    string text = fmt::format("{}{} from {} to {}", one.highest.repeats > 1 ? "mean " : "", printable(one.name),
                              short_text_of(one.lowest), short_text_of(one.highest));
    if (!one.strongest.empty())
      text += fmt::format(", mostly by {} ({:+.2f})", printable(one.strongest_name), one.correlation);
    block.line(lines++ == 0 ? "found" : "", text);
  }
}

void describe_best(Block& block, const vector<FoundMeasure>& found, string_view measure) {
  const auto best = ranges::find(found, measure, &FoundMeasure::name);
  if (best == found.end())
    block.warning("best", fmt::format("no run has a value of {}", in_backticks(measure)));
  else
    block.line(
        "best",
        fmt::format("{}{} of {} in {}", number_text(best->highest.value),
                    best->highest.repeats > 1 ? fmt::format(", the mean of {} repeats,", best->highest.repeats) : "",
                    in_backticks(measure), text_of(best->highest)));
}

Json best_json(const vector<FoundMeasure>& found, string_view measure) {
  const auto best = ranges::find(found, measure, &FoundMeasure::name);
  return best == found.end() ? Json() : run_json(best->highest);
}

Json found_json(const vector<FoundMeasure>& found) {
  Json list = Json::array();
  for (const FoundMeasure& one : found) {
    Json json = {{"measure", one.name}, {"highest", run_json(one.highest)}, {"lowest", run_json(one.lowest)}};
    json["strongest"] = one.strongest.empty() ? Json() : Json(one.strongest);
    json["rank_correlation"] = one.strongest.empty() ? Json() : Json(one.correlation);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace carom
