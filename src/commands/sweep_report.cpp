// Prints the outcome of a sweep, or its plan, from the job. Both are text for a terminal or one JSON document.
#include "commands/sweep_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/error_list.h"
#include "commands/found_report.h"
#include "commands/report.h"
#include "commands/sweep_setup.h"
#include "commands/text.h"
#include "files/failed_run.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t failures_shown = 10;

/// A line for each of the first ones: "r0003: `mass` is 0".
void describe_skipped(Block& block, const vector<pair<string, string>>& skipped) {
  if (skipped.empty()) return;
  block.warning("left out", counted(skipped.size(), "invalid run", "invalid runs"));
  for (size_t i = 0; i < min(skipped.size(), failures_shown); ++i)
    block.line("", fmt::format("{}: {}", skipped[i].first, printable(skipped[i].second)));
  if (skipped.size() > failures_shown) block.line("", fmt::format("and {} more", skipped.size() - failures_shown));
}

Json skipped_json(const vector<pair<string, string>>& skipped) {
  Json list = Json::array();
  for (const auto& [run, errors] : skipped)
    list.push_back({{"run", run}, {"errors", errors_json(error_of_text(errors))}});
  return list;
}

string state_of(const SweepJob& job, size_t number) {
  if (job.runs()[number].status == RunStatus::done) return "done";
  return stored_failure(job.run_folder(number)).empty() ? "new" : "failed";
}

string name_of(const Options& options) {
  return std::filesystem::path(options.operands.front()).stem().string();
}

Json begin_json(const Options& options, string_view status) {
  return {{"sweep", options.operands.front()}, {"status", string(status)}, {"folder", sweep_folder_of(options)}};
}

}  // namespace

int show_outcome(const Options& options, const SweepOutcome& outcome, const SweepJob& job) {
  flush_out();
  for (size_t i = 0; i < min(outcome.failures.size(), failures_shown) && !options.json; ++i) {
    const auto& [number, why] = outcome.failures[i];
    complain(options, fmt::format("{}: the run failed: {}", job.sweep().id(number), why));
  }
  if (outcome.failures.size() > failures_shown && !options.json)
    complain(options,
             fmt::format("and {} failed", counted(outcome.failures.size() - failures_shown, "more run", "more runs")));

  // Of a part there is no comparison.
  const ComparisonPlan plan = comparison_plan(job.sweep(), job.base_text());
  const bool is_part = outcome.status.starts_with("part");
  const string& best = options.sweep.best;
  const bool described = outcome.status != "up to date" || !best.empty() || options.json;
  const vector<FoundMeasure> found =
      is_part || !described ? vector<FoundMeasure>() : stored_findings(job.folder(), plan, best);

  const int code = outcome.failures.empty() ? 0 : 3;
  if (options.json) {
    Json json = begin_json(options, outcome.status);
    json["runs"] = outcome.runs;
    json["made"] = outcome.to_do - outcome.failures.size();

    Json failures = Json::array();
    for (const auto& [number, why] : outcome.failures)
      failures.push_back({{"run", job.sweep().id(number)}, {"errors", errors_json(error_of_text(why))}});
    json["failed"] = std::move(failures);
    json["skipped"] = skipped_json(outcome.skipped);
    json["doubtful"] = outcome.doubtful;
    json["wall_s"] = outcome.wall_s;
    json["found"] = found_json(found);
    if (!best.empty()) json["best"] = best_json(found, best);
    return print_end(options, code, json);
  }

  Block block(options);
  block.heading(name_of(options), job.sweep().title);
  if (outcome.status == "up to date") {
    block.line("up to date", fmt::format("{}, {}", counted(outcome.runs, "run", "runs"), printable(job.folder())));
    describe_skipped(block, outcome.skipped);
  } else {
    // What this command has done, then what stands there.
    block.line("runs", fmt::format("{}; {}", counted(outcome.runs, "run", "runs"), outcome.status));
    block.line("made", fmt::format("{}{} in {}", counted(outcome.to_do - outcome.failures.size(), "run", "runs"),
                                   outcome.failures.empty() ? "" : fmt::format(", {} failed", outcome.failures.size()),
                                   wait_text(outcome.wall_s)));

    describe_doubtful(block, outcome.doubtful);
    describe_skipped(block, outcome.skipped);
    describe(block, found);
    block.line("folder", printable(job.folder()));
    if (is_part) block.line("then", fmt::format("carom gather {}, once all parts are done", printable(job.folder())));
  }
  if (!best.empty() && !is_part) describe_best(block, found, best);
  return print_end(options, code, {}, block.text());
}

int show_failure(const Options& options, int code, const vector<ErrorRecord>& errors, const optional<SweepCut>& cut) {
  Json json = begin_json(options, code == 2 ? "wrong" : code == 1 ? "failed" : "interrupted");
  if (cut) {
    const string failed = cut->failed == 0 ? "" : fmt::format("{} failed, ", grouped(cut->failed));
    complain(options, fmt::format("{}: {} made, {}{} not run", printable(options.operands.front()),
                                  counted(cut->made, "run", "runs"), failed, grouped(cut->not_run)));
    json.update({{"made", cut->made}, {"not_run", cut->not_run}});
  }
  if (!errors.empty()) json["errors"] = errors_json(errors);
  return print_end(options, code, json);
}

int show_plan(const Options& options, const SweepJob& job) {
  const Sweep& sweep = job.sweep();
  vector<pair<string, string>> skipped;
  for (const InvalidRun& run : job.invalid()) skipped.emplace_back(sweep.id(run.number), run.messages);

  if (options.json) {
    Json json = begin_json(options, "planned");
    json["paths"] = sweep.paths;
    Json runs = Json::array();

    for (const size_t number : job.of_part()) {
      const SweepRun run = sweep.run(number);
      Json values = Json::object();
      for (size_t p = 0; p < sweep.paths.size(); ++p)
        values[sweep.paths[p]] = run.values[p] ? json_of_yaml(*run.values[p]) : Json();
      runs.push_back({{"run", run.id}, {"state", state_of(job, number)}, {"values", std::move(values)}});
    }

    json["runs"] = std::move(runs);
    json["skipped"] = skipped_json(skipped);
    return print_end(options, 0, json);
  }

  const vector<size_t> all = job.of_part();
  vector<vector<string>> rows;
  rows.push_back({"run", "state"});
  rows.front().insert(rows.front().end(), sweep.paths.begin(), sweep.paths.end());
  size_t left = 0;
  for (const size_t number : all) {
    const SweepRun run = sweep.run(number);
    rows.push_back({run.id, state_of(job, number)});
    for (const auto& value : run.values) rows.back().push_back(value ? printable(cell_text(*value)) : "-");
    left += job.runs()[number].status == RunStatus::done ? 0 : 1;
  }

  Block block(options);
  block.heading(name_of(options), sweep.title);
  block.table(rows);
  describe_skipped(block, skipped);
  block.line("to do", fmt::format("{} of {}", grouped(left), counted(all.size(), "run", "runs")));
  block.line("folder", printable(job.folder()));
  return print_end(options, 0, {}, block.text());
}

}  // namespace carom
