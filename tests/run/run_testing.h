#pragma once
// A folder of its own for each test, and scenes from files.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/mesh.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

inline Scene scene_at(const string& path) {
  LoadOptions options;
  options.mesh_points = [](const string& mesh) { return read_mesh_points(mesh); };
  return load_scene(path, options);
}

/// Those of scenes/, by name, sorted.
inline vector<string> scene_names() {
  vector<string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIR))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  ranges::sort(names);
  return names;
}

inline Scene scene_named(const string& name) {
  return scene_at(SCENES_DIR "/" + name + ".yaml");
}

class RunPlace {
 public:
  RunPlace() {
    string pattern = (std::filesystem::temp_directory_path() / "carom-run-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~RunPlace() { std::filesystem::remove_all(path_); }
  RunPlace(const RunPlace&) = delete;
  RunPlace& operator=(const RunPlace&) = delete;

  string operator/(const string& name) const { return path_ / name; }
  /// The scene of this text.
  Scene scene(const string& yaml) const {
    std::ofstream(path_ / "scene.yaml") << yaml;
    return scene_at(path_ / "scene.yaml");
  }

 private:
  std::filesystem::path path_;
};

}  // namespace carom
