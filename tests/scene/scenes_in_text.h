#pragma once
// Scenes as text in a test -> files in that test's own folder -> scenes or the text of their errors.
#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>

#include "scene/load.h"
#include "std.h"

namespace carom {

inline string test_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const string folder =
      testing::TempDir() + "carom_scene_" + to_string(getpid()) + "_" + info->test_suite_name() + "." + info->name();
  std::filesystem::create_directories(folder);
  return folder;
}

/// In a folder of the running test.
inline string write_file(string_view text, const string& name = "scene.yaml") {
  const string path = test_folder() + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

inline Scene load_text(string_view text, const LoadOptions& options = {}) {
  const string path = write_file(text);
  try {
    Scene scene = load_scene(path, options);
    std::filesystem::remove_all(test_folder());
    return scene;
  } catch (const SceneError&) {
    std::filesystem::remove_all(test_folder());
    throw;
  }
}

/// All errors of a scene, the file named as "scene.yaml"; empty: it loads.
inline string errors_of(string_view text, const LoadOptions& options = {}) {
  const string folder = test_folder() + "/";
  try {
    load_text(text, options);
    return "";
  } catch (const SceneError& error) {
    string out = error.what();
    for (size_t i = out.find(folder); i != string::npos; i = out.find(folder, i)) out.erase(i, folder.size());
    return out;
  }
}

inline string errors_with(string_view text, const string& set) {
  LoadOptions options;
  options.set = {set};
  return errors_of(text, options);
}

/// A scene that is complete except for the test's part. Constants of other files begin with it: an inline constant may
/// be made after theirs, in the order of the linker.
const string start = "scene: 1\nsimulate: {duration: 1}\n";

}  // namespace carom
