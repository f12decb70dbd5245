#pragma once
// A folder of its own for each test, and scenes from files.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "render/mesh.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace carom {

inline Scene scene_at(const std::string& path) {
  LoadOptions options;
  options.mesh_points = [](const std::string& mesh) { return read_mesh_points(mesh); };
  return load_scene(path, options);
}

/// Those of scenes/, by name, sorted.
inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIR))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline Scene scene_named(const std::string& name) {
  return scene_at(SCENES_DIR "/" + name + ".yaml");
}

class RunPlace {
 public:
  RunPlace() {
    std::string pattern = (std::filesystem::temp_directory_path() / "carom-run-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~RunPlace() { std::filesystem::remove_all(path_); }
  RunPlace(const RunPlace&) = delete;
  RunPlace& operator=(const RunPlace&) = delete;

  std::string operator/(const std::string& name) const { return path_ / name; }
  /// The scene of this text.
  Scene scene(const std::string& yaml) const {
    std::ofstream(path_ / "scene.yaml") << yaml;
    return scene_at(path_ / "scene.yaml");
  }

 private:
  std::filesystem::path path_;
};

}  // namespace carom
