// Makes text and JSON together. An outcome is packed into one text, which another process sends through a pipe.
#include "commands/scene_outcome.h"

#include <fmt/format.h>

#include "commands/accuracy_report.h"
#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/table_sizes.h"
#include "commands/text.h"
#include "files/checkpoint_file.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

Json begin(const PlannedScene& planned, string_view status) {
  return {{"scene", planned.file}, {"status", string(status)}, {"folder", planned.folder}};
}

string doubtful_text(const PlannedScene& planned, const vector<Warning>& warnings) {
  string text;
  for (const Warning& warning : warnings)
    text += fmt::format("{}{}: doubtful: {}", text.empty() ? "" : "\ncarom: ", printable(planned.file), warning.text);
  return text;
}

/// The run's members of the document.
void add_members(Json& entry, const PlannedScene& planned, const RunResult& result) {
  entry["summary"] = summary_json(result.summary);
  entry["contact"] = contact_json(result.summary);
  if (!result.summary.contact.events.empty()) entry["events"] = events_json(result.summary);
  if (!result.summary.energy.of_forces.empty()) entry["work"] = work_json(result.summary);
  entry["warnings"] = warnings_json(result.summary.warnings);
  entry["files"] = files_in(planned.folder);
  entry["tables"] = sizes_json(result.facts.tables);
  entry["time"] = times_json(result);
}

}  // namespace

SceneOutcome without_run(const PlannedScene& planned, string_view status) {
  return {string(status), begin(planned, status), {}, {}};
}

SceneOutcome wrong_scene(const PlannedScene& planned) {
  SceneOutcome outcome = without_run(planned, "wrong");
  outcome.entry["errors"] = errors_json(planned.records);
  return outcome;
}

SceneOutcome run_done(const PlannedScene& planned, const RunResult& result, const Options& options) {
  SceneOutcome outcome = without_run(planned, scene_status::done);
  add_members(outcome.entry, planned, result);

  Block block(options);
  block.heading(planned.name, planned.scene->title);
  describe(block, planned, result);
  if (options.accuracy) {
    const AccuracyReport accuracy = report_accuracy(*planned.scene, result.engine);
    outcome.entry["accuracy"] = accuracy.json;
    for (const auto& [label, text] : accuracy.lines) block.line(label, text);
  }

  outcome.out = block.text();
  if (options.quiet) outcome.complaint = doubtful_text(planned, result.summary.warnings);
  return outcome;
}

SceneOutcome run_up_to_date(const PlannedScene& planned, const Options& options) {
  SceneOutcome outcome = without_run(planned, scene_status::up_to_date);
  outcome.entry["files"] = files_in(planned.folder);
  const vector<Warning> warnings = warnings_in(planned.folder);
  outcome.entry["warnings"] = warnings_json(warnings);
  Block block(options);
  block.heading(planned.name, planned.scene->title);
  block.line("up to date", printable(planned.folder));
  describe(block, warnings);
  outcome.out = block.text();
  return outcome;
}

SceneOutcome run_failed(const PlannedScene& planned, string_view why) {
  const string text = with_remedy(string(why));
  SceneOutcome outcome = without_run(planned, scene_status::failed);
  outcome.entry["errors"] = errors_json(error_of_text(text, planned.file));
  outcome.complaint = fmt::format("{}: the run failed: {}", printable(planned.file), text);
  return outcome;
}

SceneOutcome run_interrupted(const PlannedScene& planned) {
  SceneOutcome outcome = without_run(planned, scene_status::interrupted);
  const optional<Checkpoint> kept = any_checkpoint(planned.folder);
  const string how = kept ? fmt::format(" at {:.4g} s of its motion; the same command goes on there", kept->time)
                          : "; the same command runs what is missing";
  outcome.complaint = fmt::format("{}: interrupted{}", printable(planned.file), how);
  return outcome;
}

string packed(const SceneOutcome& outcome) {
  return text_of_json(Json::array({outcome.status, outcome.entry, outcome.out, outcome.complaint}));
}

SceneOutcome unpacked(const string& text) {
  Json parts = json_of_text(text);
  return {parts[0], std::move(parts[1]), parts[2], parts[3]};
}

}  // namespace carom
