// The manifest names the scene file by its path from the folder. Stems and hashes of content would not do: two scenes
// in two folders may have one stem, and an edited file has another hash.
#include "files/earlier_run.h"

#include <fcntl.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "files/folder_names.h"
#include "files/manifest.h"
#include "files/open_folder.h"
#include "files/run_folder.h"
#include "files/series_folders.h"

namespace carom {
namespace {

/// The first entry of a run's folder that neither the manifest nor a former run accounts for.
std::string foreign_entry(const FoundFolder& found, const Manifest& manifest) {
  std::set<std::string> known = {manifest_name, failure_file};
  for (const FileRecord& file : manifest.files) known.insert(file.name);
  SeriesFolders folders(found.folder.get());
  for (const std::string& name : found.names) {
    if (known.contains(name) || is_part_name(name)) continue;
    const std::vector<std::string> series = series_folder_names();
    const int inner = std::find(series.begin(), series.end(), name) == series.end() ? -1 : folders.open(name);
    if (inner < 0) return name;
    for (const std::string& entry : folder_names(inner)) {
      std::string path = name + "/";
      path += entry;
      if (!known.contains(path) && !is_part_name(entry)) return path;
    }
  }
  return {};
}

}  // namespace

std::string path_from(const std::string& folder, const std::string& scene_file) {
  // Of a relative path that does not exist the canonical form is relative.
  const std::filesystem::path file = canonical(absolute(scene_file));
  return valid_utf8(file.lexically_relative(canonical(absolute(folder))).string());
}

EarlierRun find_earlier_run(const std::string& path, const SceneOrigin& origin) {
  EarlierRun run;
  const FoundFolder found = find_folder(path);
  const auto manifest = found.folder ? read_manifest(found.folder.get(), manifest_name) : std::nullopt;
  run.of_scene = manifest && !origin.path.empty() && manifest->origin == origin;
  if (!run.of_scene) return run;
  run.touched = wrong_file(found.folder.get(), *manifest, [](std::string_view) { return false; });
  run.foreign = foreign_entry(found, *manifest);
  return run;
}

}  // namespace carom
