#pragma once
// A folder of its own for each test, and scenes from files.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "paths.h"
#include "render/mesh.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
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

/// For tests that run each scene several times. Those of many contacts or of gravity end early (s), with thousands of
/// collisions and a few merges behind them; ./dev stress runs them to their end.
inline Scene scene_in_short(const string& name) {
  static const map<string, double> durations = {
      {"balls_in_a_box", 1.5},   {"binary_stars", 0.8},   {"brick_wall", 1.2},
      {"funnel", 0.4},           {"hourglass", 0.6},      {"lattice", 0.37},
      {"pi_to_six_digits", 1.5}, {"pour_into_bowl", 1.5}, {"shaken_tray", 1.2}};
  Scene scene = scene_named(name);
  if (const auto found = durations.find(name); found != durations.end() && !slow_too())
    scene.simulate.duration = found->second;
  return scene;
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
