// Shares a sweep's folder between parts by flock: exclusive to write sweep.yaml and base.yaml, then shared.
// No run begins before base.yaml is complete.
#include "study/sweep_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "files/copied_run.h"
#include "files/csv.h"
#include "files/folder_names.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "scene/output_kinds.h"
#include "scene/path_field.h"
#include "scene/scene.h"
#include "scene/scene_values.h"
#include "std.h"
#include "version.h"
#include "yaml/source.h"
#include "yaml/value_json.h"

namespace carom {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr uint64_t largest = 1 << 30;  // bytes of sweep.yaml and of base.yaml
constexpr auto lock_patience = std::chrono::seconds(30);

constexpr const char* sweep_key = "sweep";

/// None: it is absent, or not a sweep's.
optional<Manifest> read_sweep_manifest(int folder) {
  auto manifest = read_manifest(folder, manifest_name);
  return manifest && json_of_text(manifest->outputs).contains(sweep_key) ? std::move(manifest) : nullopt;
}

bool is_whole(int folder, const string& path, const Sweep& sweep, const Manifest& manifest) {
  if (manifest.version != program_version || !wrong_file(folder, manifest, depends_on_look).empty()) return false;
  const string mark = path + "/" + manifest_name;
  set<string> absent(manifest.failed.begin(), manifest.failed.end());
  for (auto& [id, errors] : stored_skips(path)) absent.insert(std::move(id));
  for (size_t number = 0; number < sweep.size(); ++number) {
    const string id = sweep.id(number);
    if (!absent.contains(id) && !is_whole_since(path + "/runs/" + id, mark)) return false;
  }
  return true;
}

/// The part of a sweep's text that determines the runs: from its base on, without the comparison.
string_view runs_part(string_view text) {
  const size_t begin = min(text.find("\nbase: "), text.size());
  return text.substr(begin, min(text.find("\ncompare:\n"), text.size() - 1) - begin);
}

/// Whether the folder's runs are those of this sweep.
bool has_runs_of(int folder, const Sweep& sweep, const string& base_text) {
  const auto stored = read_text(folder, stored_sweep, largest);
  return stored && runs_part(*stored) == runs_part(sweep.resolved(stored_base)) &&
         read_text(folder, stored_base, largest) == base_text;
}

/// Whether this sweep was interrupted, or ran out of space, before base.yaml was complete. No run begins before that.
bool has_begun(const FoundFolder& found, const Sweep& sweep) {
  const bool alone = all_of(found.names, [](const auto& name) { return name == stored_sweep || is_part_name(name); });
  return alone && read_text(found.folder.get(), stored_sweep, largest) == sweep.resolved(stored_base);
}

}  // namespace

SweepContent inspect_sweep_folder(const string& path, const Sweep& sweep, const string& base_text) {
  const FoundFolder found = find_folder(path);
  if (found.content == FolderContent::nothing || found.content == FolderContent::incomplete)
    return SweepContent::nothing;
  if (found.folder && has_begun(found, sweep)) return SweepContent::same_runs;
  if (!found.folder || !has_runs_of(found.folder.get(), sweep, base_text)) return SweepContent::other;
  if (read_text(found.folder.get(), stored_sweep, largest) != sweep.resolved(stored_base))
    return SweepContent::same_runs;
  const auto manifest = read_sweep_manifest(found.folder.get());
  const bool whole = manifest && is_whole(found.folder.get(), path, sweep, *manifest);
  return whole ? SweepContent::this_sweep : SweepContent::same_runs;
}

bool is_ended_sweep(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  const auto manifest = folder ? read_sweep_manifest(folder.get()) : nullopt;
  const auto is_other = [](string_view name) { return name != stored_sweep && name != stored_base; };
  return manifest && wrong_file(folder.get(), *manifest, is_other).empty();
}

string skipped_text(const Sweep& sweep, const string& base_text, const vector<InvalidRun>& invalid) {
  if (invalid.empty()) return "";
  const CsvDialect dialect(own_tables(base_text));
  string text = fmt::format("run{}error\n", dialect.separator);
  for (const InvalidRun& run : invalid) {
    text += sweep.id(run.number) + dialect.separator;
    text += text_cell(run.messages, dialect) + "\n";
  }
  return text;
}

vector<pair<string, string>> stored_skips(const string& path) {
  vector<pair<string, string>> skips;
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  Descriptor file = folder ? open_stored(folder.get(), stored_skipped) : Descriptor();
  if (!file) return skips;
  StoredTable table(std::move(file));
  while (const auto* cells = table.next())
    if (cells->size() == 2) skips.emplace_back((*cells)[0], (*cells)[1]);
  return skips;
}

vector<string> stored_failures(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  const auto manifest = folder ? read_sweep_manifest(folder.get()) : nullopt;
  return manifest ? manifest->failed : vector<string>();
}

SweepFolder::SweepFolder(const string& path, Use use, const Sweep& sweep, const string& base_text,
                         const string& skipped, const function<void()>& stop_check)
    : base_text_(base_text) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail("make", {-1, path}, "", error.message());
  folder_ = open_folder(AT_FDCWD, path, true);
  if (!folder_) fail("open", {-1, path}, "");
  place_ = {folder_.get(), path};

  const string busy =
      "another sweep, or another part of this one, is writing into it; wait for it, or name another folder with -o";

  if (use == Use::exclusive) {
    if (!lock_folder(place_, LockKind::alone)) fail("write", place_, "", busy);
    finish_publication(place_, Durability::synced);
    for (const char* name : {summary_name, repeats_name, workbook_name, page_name}) refuse_folder(place_, name);
    begin(sweep, base_text, skipped);
    return;
  }

  // Several parts may begin at once. One of them writes, and the others find the files complete.
  const auto start = std::chrono::steady_clock::now();
  while (true) {
    if (!lock(LockKind::shared, stop_check)) fail("write", place_, "", busy);
    if (has(stored_sweep, sweep.resolved(stored_base)) && has(stored_base, base_text) && has(stored_skipped, skipped))
      break;

    if (lock_folder(place_, LockKind::alone)) begin(sweep, base_text, skipped);
    if (std::chrono::steady_clock::now() - start > lock_patience) fail("write", place_, "", busy);
    flock(folder_.get(), LOCK_UN);
    stop_check();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  begin(sweep, base_text, skipped);
}

void SweepFolder::begin(const Sweep& sweep, const string& base_text, const string& skipped) {
  if (!has_runs_of(place_.folder, sweep, base_text)) remove_runs();
  put(stored_sweep, sweep.resolved(stored_base));
  put(stored_base, base_text);
  if (skipped.empty())
    remove_file(place_, stored_skipped);
  else
    put(stored_skipped, skipped);
}

/// False: the lock was held elsewhere all the time.
bool SweepFolder::lock(LockKind kind, const function<void()>& stop_check) const {
  const auto start = std::chrono::steady_clock::now();
  while (!lock_folder(place_, kind)) {
    if (std::chrono::steady_clock::now() - start > lock_patience) return false;
    stop_check();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// A run of another sweep must not be taken for one of this sweep.
void SweepFolder::remove_runs() const {
  const string path = place_.path + "/runs";
  const Descriptor runs = open_folder(AT_FDCWD, path, false);
  if (!runs) return;
  for (const string& name : folder_names(runs.get())) remove_run(path + "/" + name);
}

bool SweepFolder::has(const char* name, const string& text) const {
  return read_text(place_.folder, name, largest).value_or("") == text;
}

void SweepFolder::put(const char* name, const string& text) {
  if (!has(name, text)) {
    OutputFile file(place_, name);
    file.write(text);
    file.publish();
  }
  if (auto record = read_record(place_.folder, name)) begun_.push_back(std::move(*record));
}

ComparisonPlan comparison_plan(const Sweep& sweep, const string& base_text) {
  ComparisonPlan plan;
  plan.title = sweep.title;
  for (const string& path : sweep.paths) {
    const Field* field = field_at(path);
    plan.parameters.push_back({path, field == nullptr ? "" : string(field->unit)});
  }
  for (const SweepMeasure& measure : sweep.measures) plan.measures.push_back(measure.name);
  for (const SweepChart& chart : sweep.charts) plan.charts.push_back({chart.x, chart.y, chart.by});
  plan.own = own_measure_names(base_text);
  if (sweep.seeds > 0) plan.seed = sweep.paths.size() - 1;
  plan.collisions = sweep.collisions;
  return plan;
}

namespace {

/// The values of a scene file by their paths. Empty: there is no such file.
vector<SceneValue> values_in(const string& folder, const char* name) {
  const Descriptor place = open_folder(AT_FDCWD, folder, true);
  const auto text = place ? read_text(place.get(), name, max_source_bytes) : nullopt;
  return text ? scene_values(folder + "/" + name, *text) : vector<SceneValue>();
}

}  // namespace

ComparedRun compared_run(const Sweep& sweep, size_t number, const string& folder) {
  const SweepRun run = sweep.run(number);
  ComparedRun out{run.id, folder, {}};
  optional<vector<SceneValue>> own, base;  // of the scenes

  const auto take = [&](size_t p, const vector<SceneValue>& values) {
    for (const SceneValue& value : values)
      if (value.path == sweep.paths[p] && !value.text.starts_with('=')) out.values[p] = value.text;
  };
  for (size_t p = 0; p < run.values.size(); ++p) {
    out.values.push_back(run.values[p] ? cell_text(*run.values[p]) : "");
    // The scene of a run has the number of an expression, and no `defaults`, which the base has.
    if (!out.values.back().empty() && !out.values.back().starts_with('=')) continue;
    if (!own) own = values_in(folder, "scene.yaml");
    take(p, *own);
    if (!out.values.back().empty() || run.values[p]) continue;
    if (!base) base = values_in(folder + "/../..", stored_base);
    take(p, *base);
  }
  return out;
}

void SweepFolder::finish(const Sweep& sweep, const vector<RunStatus>& statuses, const ComparisonWatch& watch) {
  // The runs must survive a power failure before the manifest lists them.
  sync_file_system(place_.path);

  vector<size_t> kept;
  for (size_t number = 0; number < statuses.size(); ++number)
    if (statuses[number] != RunStatus::left_out) kept.push_back(number);

  const auto compared = [&](size_t row) {
    const size_t number = kept[row];
    ComparedRun run = compared_run(sweep, number, fmt::format("{}/runs/{}", place_.path, sweep.id(number)));
    run.failed = statuses[number] != RunStatus::done;
    return run;
  };
  vector<unique_ptr<OutputFile>> files =
      write_comparison(place_, comparison_plan(sweep, base_text_), kept.size(), compared, watch);

  Json failed = Json::array();
  for (const size_t number : kept)
    if (statuses[number] != RunStatus::done) failed.push_back(sweep.id(number));
  Json facts;
  facts["counts"] = {{"runs", kept.size()}, {"done", kept.size() - failed.size()}, {"failed", failed.size()}};
  if (kept.size() < statuses.size()) facts["counts"]["skipped"] = statuses.size() - kept.size();
  facts["failed"] = std::move(failed);

  const Json outputs = {{sweep_key, {{"title", valid_utf8(sweep.title)}}}};
  vector<FileRecord> records = begun_;
  for (const auto& file : files) records.push_back(file->record());
  OutputFile manifest(place_, manifest_name);
  manifest.write(manifest_text(text_of_json(outputs), text_of_json(facts), records));
  manifest.complete();

  vector<PartFile*> parts;
  for (const auto& file : files) parts.push_back(file.get());
  publish(place_, Durability::synced, parts, manifest);
}

}  // namespace carom
