// The manifest names the scene file by its path from the folder. Stems and hashes of content would not do: two scenes
// in two folders may have one stem, and an edited file has another hash.
#include "files/earlier_run.h"

#include <filesystem>

#include "files/checkpoint_file.h"
#include "files/folder_names.h"
#include "files/folders.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "files/series_folders.h"
#include "std.h"

namespace carom {
namespace {

/// The first entry that no interrupted run leaves. Empty: there is none.
string entry_of_no_run(const FoundFolder& found) {
  const vector<string> series = series_folder_names();
  const auto is_foreign = [&](const string& name) {
    return name != "scene.yaml" && !is_part_name(name) && !contains(series, name);
  };
  const auto entry = ranges::find_if(found.names, is_foreign);
  return entry == found.names.end() ? "" : *entry;
}

}  // namespace

string path_from(const string& folder, const string& scene_file) {
  // Of a relative path that does not exist the canonical form is relative.
  const std::filesystem::path file = canonical(absolute(scene_file));
  return valid_utf8(file.lexically_relative(canonical(absolute(folder))).string());
}

EarlierRun find_earlier_run(const string& path, const SceneOrigin& origin) {
  EarlierRun run;
  const FoundFolder found = find_folder(path);
  if (!found.folder || origin.path.empty()) return run;
  if (const auto manifest = read_manifest(found.folder.get(), manifest_name)) {
    run.of_scene = manifest->origin == origin;
    if (run.of_scene) run.changes = find_changes(path);
  } else if (const auto kept = any_checkpoint(FilePlace{found.folder.get(), path})) {
    run.of_scene = kept->origin == origin;
    run.changes.foreign = entry_of_no_run(found);
  }
  return run;
}

}  // namespace carom
