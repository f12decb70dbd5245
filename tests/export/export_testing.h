#pragma once
// Shared by the tests of src/export: temporary folders, small scenes, pictures.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "export/exports.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing_export {

namespace fs = std::filesystem;

/// A new folder, removed at the end.
class TempFolder {
 public:
  TempFolder() {
    string name = ::testing::TempDir() + "carom_export_XXXXXX";
    if (!mkdtemp(name.data())) ADD_FAILURE() << "mkdtemp";
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  string operator/(const string& name) const { return path_ + "/" + name; }
  const string& path() const { return path_; }

 private:
  string path_;
};

inline string read(const string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write(const string& path, const string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// All entries below a folder, hidden files included, sorted.
inline vector<string> names_in(const string& folder) {
  vector<string> names;
  if (fs::exists(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      names.push_back(fs::relative(entry.path(), folder).string());
  ranges::sort(names);
  return names;
}

/// Two balls and a group of two, a plane, no output at all, 0.2 s.
inline Scene small_scene() {
  Scene scene;
  scene.file = "scenes/small.yaml";
  scene.title = "Small";

  scene.world.mass = {2, 1, 1, 1};
  scene.world.radius = {0.1, 0.1, 0.1, 0.1};
  scene.world.restitution = {1, 1, 1, 1};
  scene.world.gravity = Vec3(0, -10, 0);
  scene.world.planes = {{Vec3(0, 0, 0), Vec3(0, 1, 0), {}}};

  scene.initial.position = {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(3, 1, 0)};
  scene.initial.velocity = {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  scene.roster.bodies = {{"red", 0, 1, false, {}}, {"blue", 1, 1, false, {}}, {"gas", 2, 2, true, {}}};
  scene.roster.fixed = {{"floor", {}, true}};

  scene.simulate.duration = 0.2;
  scene.resolved = "scene: 1\ntitle: Small\n";
  return scene;
}

/// A smooth picture that differs from pixel to pixel and from `phase` to `phase`.
inline Image picture(Size size, int phase) {
  Image image{size.width, size.height, {}};
  image.pixels.reserve(static_cast<size_t>(size.width * size.height) * 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (const int value : {x + phase, y + 2 * phase, x + y}) image.pixels.push_back(static_cast<uint8_t>(value));
  return image;
}

/// Runs through a timeline as `run` does, with the scene's initial state throughout.
inline void play(const Scene& scene, Exports& exports, const vector<ContactForce>& contacts = {}) {
  while (exports.tables().timeline().advance()) exports.tables().sample(scene.initial, contacts);
  if (!exports.draws()) return;
  exports.begin_drawings();
  const Timeline& timeline = exports.drawings().timeline();
  while (exports.drawings().timeline().advance()) {
    exports.drawings().sample(scene.initial);
    for (size_t i = 0; i < exports.pictures().size(); ++i)
      if (const auto due = timeline.due(exports.pictures()[i].timeline_stream))
        exports.picture(i, picture(exports.pictures()[i].size, static_cast<int>(*due)));
  }
}

inline Summary some_summary(const Scene& scene) {
  Summary summary;
  summary.run = "small";
  summary.title = scene.title;
  summary.engine = "exact";
  summary.status = "done";
  return summary;
}

/// A whole run.
inline void run(const Scene& scene, const string& folder, const vector<ContactForce>& contacts = {}) {
  Exports exports(scene, folder);
  play(scene, exports, contacts);
  Summary summary = some_summary(scene);
  summary.frames = exports.frames();
  exports.finish(summary, {});
}

inline string error_of(const function<void()>& action) {
  try {
    action();
  } catch (const ExportError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace carom::testing_export
