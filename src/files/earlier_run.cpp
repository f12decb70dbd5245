// The manifest names the scene file by its path from the folder. Stems and hashes of content would not do: two scenes
// in two folders may have one stem, and an edited file has another hash.
#include "files/earlier_run.h"

#include <filesystem>

#include "files/manifest.h"
#include "files/open_folder.h"
#include "files/run_folder.h"

namespace carom {

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
  run.changes = find_changes(path);
  return run;
}

}  // namespace carom
