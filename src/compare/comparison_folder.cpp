// A folder without manifest is replaced only if all its files are those of a comparison, or temporary.
// A folder with a manifest of another kind belongs to another run.
#include "compare/comparison_folder.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "files/folder_names.h"
#include "files/manifest.h"
#include "files/stored_file.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "version.h"
#include "yaml/printable.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* request_key = "comparison";

bool is_comparison_file(const string& name) {
  const array<string_view, 5> names = {summary_name, repeats_name, workbook_name, page_name, comparison_film_name};
  return contains(names, name);
}

bool is_comparison(const Manifest& manifest) {
  const Json outputs = json_of_text(manifest.outputs);
  return outputs.is_object() && outputs.contains(request_key);
}

}  // namespace

string request_text(const ComparisonPlan& plan, const string& runs, bool video) {
  Json charts = Json::array();
  for (const Chart& chart : plan.charts) charts.push_back({{"x", chart.x}, {"y", chart.y}, {"by", chart.by}});
  const Json request = {{request_key,
                         {{"title", valid_utf8(plan.title)},
                          {"runs_sha256", runs},
                          {"measures", plan.measures},
                          {"charts", std::move(charts)},
                          {"collisions", plan.collisions},
                          {"video", video}}}};
  return text_of_json(request);
}

FolderChanges changes_of_comparison(const string& folder) {
  return find_changes(folder, is_comparison_file);
}

string comparison_obstacle(const FolderChanges& changes) {
  if (!changes.changed.empty()) return fmt::format("a comparison with a changed file, {}", printable(changes.changed));
  if (!changes.foreign.empty()) return fmt::format("{}, which no comparison wrote", printable(changes.foreign));
  return {};
}

FolderContent inspect_comparison_folder(const string& path, const string& request, FolderChanges& changes) {
  const FoundFolder found = find_folder(path);
  const Descriptor& folder = found.folder;
  if (found.names.empty()) return found.content;
  if (!found.has(manifest_name)) {
    // A comparison that was killed during writing, or while its files were renamed.
    const bool ours =
        all_of(found.names, [](const auto& name) { return is_part_name(name) || is_comparison_file(name); });
    return ours ? FolderContent::incomplete : FolderContent::other_run;
  }
  const auto manifest = read_manifest(folder.get(), manifest_name);
  if (!manifest || !is_comparison(*manifest)) return FolderContent::other_run;
  const bool whole = all_of(manifest->files, [&](const FileRecord& file) {
    const auto stored = read_record(folder.get(), file.name);
    return stored && stored->bytes == file.bytes && stored->sha256 == file.sha256;
  });
  if (whole && manifest->version == program_version && manifest->outputs == request) return FolderContent::this_run;
  changes = changes_of_comparison(path);
  return comparison_obstacle(changes).empty() ? FolderContent::incomplete : FolderContent::touched;
}

void ComparisonFolder::publish(const vector<unique_ptr<OutputFile>>& files, SideBySide* film, const string& request) {
  vector<PartFile*> all;
  vector<FileRecord> records;
  for (const auto& file : files) {
    all.push_back(file.get());
    records.push_back(file->record());
  }

  if (film != nullptr) {
    all.push_back(&film->file());
    records.push_back(film->record());
  }

  OutputFile manifest(folder_.place(), manifest_name);
  manifest.write(manifest_text(request, "{}", records));
  manifest.complete();
  folder_.publish(std::move(all), manifest);
}

}  // namespace carom
