#include "study/sweep_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "export/copied_run.h"
#include "export/folder_names.h"
#include "export/manifest.h"
#include "export/open_folder.h"
#include "export/stored_file.h"
#include "scene/path_field.h"
#include "scene/scene_values.h"
#include "scene/source.h"
#include "scene/value_json.h"

namespace carom {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::uint64_t largest = 1 << 30;  // bytes of a manifest, and of what is read whole beside it
constexpr auto patience = std::chrono::seconds(30);

/// None: it is not there, or no sweep's.
std::optional<Json> read_sweep_manifest(int folder) {
  const auto text = read_text(folder, manifest_name, largest);
  if (!text) return std::nullopt;
  Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || json.value("tool", "") != "carom" || !json.contains("sweep") || !json.contains("failed") ||
      !json["failed"].is_array() || !json.contains("files") || !json["files"].is_array())
    return std::nullopt;
  return json;
}

std::vector<std::string> failures_of(const Json& manifest) {
  std::vector<std::string> out;
  for (const Json& id : manifest["failed"])
    if (id.is_string()) out.push_back(id.get<std::string>());
  return out;
}

bool is_whole(int folder, const std::string& path, const Sweep& sweep, const Json& manifest) {
  if (manifest.value("version", "") != CAROM_VERSION) return false;
  for (const Json& file : manifest["files"]) {
    const auto record = read_record(folder, file.value("name", ""));
    if (!record || record->sha256 != file.value("sha256", "")) return false;
  }
  const std::string mark = path + "/" + manifest_name;
  const std::vector<std::string> failed = failures_of(manifest);
  for (std::size_t number = 0; number < sweep.size(); ++number) {
    const std::string id = sweep.id(number);
    if (std::find(failed.begin(), failed.end(), id) == failed.end() && !is_whole_since(path + "/runs/" + id, mark))
      return false;
  }
  return true;
}

}  // namespace

SweepContent inspect_sweep_folder(const std::string& path, const Sweep& sweep, const std::string& base_text) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  if (!folder && errno == ENOENT) return SweepContent::nothing;
  if (!folder && errno == ENOTDIR) return SweepContent::other;
  if (!folder) fail("open", {-1, path}, "");
  const std::vector<std::string> names = folder_names(folder.get());
  if (std::all_of(names.begin(), names.end(), is_part_name)) return SweepContent::nothing;
  if (read_text(folder.get(), stored_sweep, largest) != sweep.resolved(stored_base) ||
      read_text(folder.get(), stored_base, largest) != base_text)
    return SweepContent::other;
  const std::optional<Json> manifest = read_sweep_manifest(folder.get());
  const bool whole = manifest && is_whole(folder.get(), path, sweep, *manifest);
  return whole ? SweepContent::this_sweep : SweepContent::incomplete;
}

std::vector<std::string> stored_failures(const std::string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  const std::optional<Json> manifest = folder ? read_sweep_manifest(folder.get()) : std::nullopt;
  return manifest ? failures_of(*manifest) : std::vector<std::string>();
}

SweepFolder::SweepFolder(const std::string& path, Use use, const Sweep& sweep, const std::string& base_text,
                         const std::function<void()>& look) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail("make", {-1, path}, "", error.message());
  folder_ = open_folder(AT_FDCWD, path, true);
  if (!folder_) fail("open", {-1, path}, "");
  place_ = {folder_.get(), path};
  const auto begin = [&] {
    put(stored_sweep, sweep.resolved(stored_base));
    put(stored_base, base_text);
  };
  const std::string busy =
      "another sweep, or another part of this one, is writing into it; wait for it, or name another folder with -o";
  if (use == Use::alone) {
    if (!lock(LOCK_EX | LOCK_NB, [] {})) fail("write", place_, "", busy);
    begin();
    return;
  }
  // Several parts may begin at once: one of them writes, the others find it done.
  const auto start = std::chrono::steady_clock::now();
  while (true) {
    if (!lock(LOCK_SH | LOCK_NB, look)) fail("write", place_, "", busy);
    if (has(stored_sweep, sweep.resolved(stored_base)) && has(stored_base, base_text)) break;
    if (flock(folder_.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) begin();
    if (std::chrono::steady_clock::now() - start > patience) fail("write", place_, "", busy);
    flock(folder_.get(), LOCK_UN);
    look();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  begin();
}

/// A file system that knows no locks (some network ones) is used without.
bool SweepFolder::lock(int how, const std::function<void()>& look) const {
  const auto start = std::chrono::steady_clock::now();
  while (flock(folder_.get(), how) != 0 && errno == EWOULDBLOCK) {
    if (how == (LOCK_EX | LOCK_NB) || std::chrono::steady_clock::now() - start > patience) return false;
    look();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

bool SweepFolder::has(const char* name, const std::string& text) const {
  return read_text(place_.folder, name, largest) == text;
}

void SweepFolder::put(const char* name, const std::string& text) {
  if (!has(name, text)) {
    OutputFile file(place_, name);
    file.write(text);
    file.publish();
  }
  if (auto record = read_record(place_.folder, name)) begun_.push_back(std::move(*record));
}

ComparisonPlan comparison_plan(const Sweep& sweep) {
  ComparisonPlan plan;
  plan.title = sweep.title;
  for (const std::string& path : sweep.paths) {
    const Field* field = field_at(path);
    plan.parameters.push_back({path, field == nullptr ? "" : std::string(field->unit)});
  }
  for (const SweepMeasure& measure : sweep.measures) plan.measures.push_back(measure.name);
  for (const SweepChart& chart : sweep.charts) plan.charts.push_back({chart.x, chart.y, chart.by});
  if (sweep.seeds > 0) plan.seed = sweep.paths.size() - 1;
  return plan;
}

ComparedRun compared_run(const Sweep& sweep, std::size_t number, const std::string& folder) {
  const SweepRun run = sweep.run(number);
  ComparedRun out{run.id, folder, {}};
  std::optional<std::vector<SceneValue>> own;  // the scene's
  for (std::size_t p = 0; p < run.values.size(); ++p) {
    out.values.push_back(run.values[p] ? cell_text(*run.values[p]) : "");
    if (run.values[p]) continue;
    if (!own) {
      const Descriptor place = open_folder(AT_FDCWD, folder, true);
      const auto text = place ? read_text(place.get(), "scene.yaml", max_source_bytes) : std::nullopt;
      own = text ? scene_values(folder + "/scene.yaml", *text) : std::vector<SceneValue>();
    }
    for (SceneValue& value : *own)
      if (value.path == sweep.paths[p]) out.values[p] = std::move(value.text);
  }
  return out;
}

void SweepFolder::finish(const Sweep& sweep, const std::vector<RunStatus>& statuses, const ComparisonWatch& watch) {
  sync_file_system(place_.path);  // what the manifest says of runs must outlast a power cut before it is said
  const auto compared = [&](std::size_t number) {
    return compared_run(sweep, number, fmt::format("{}/runs/{}", place_.path, sweep.id(number)));
  };
  std::vector<std::unique_ptr<OutputFile>> files =
      write_comparison(place_, comparison_plan(sweep), sweep.size(), compared, watch);

  Json json;
  json["tool"] = "carom";
  json["version"] = CAROM_VERSION;
  json["sweep"] = {{"title", sweep.title}};
  Json failed = Json::array();
  for (std::size_t number = 0; number < statuses.size(); ++number)
    if (statuses[number] != RunStatus::done) failed.push_back(sweep.id(number));
  json["counts"] = {{"runs", statuses.size()}, {"done", statuses.size() - failed.size()}, {"failed", failed.size()}};
  json["failed"] = std::move(failed);
  std::vector<FileRecord> records = begun_;
  for (const auto& file : files) records.push_back(file->record());
  json["files"] = Json::array();
  for (const FileRecord& file : records)
    json["files"].push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  OutputFile manifest(place_, manifest_name);
  manifest.write(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  manifest.complete();

  // First the folder stops being a whole sweep; names follow bytes, and the manifest's name the others'.
  if (unlinkat(place_.folder, manifest_name, 0) != 0 && errno != ENOENT) fail("replace", place_, manifest_name);
  sync_file_system(place_.path);
  for (const auto& file : files) file->publish();
  sync_file_system(place_.path);
  manifest.publish();
  sync_file_system(place_.path);
}

}  // namespace carom
