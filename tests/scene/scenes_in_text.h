#pragma once
// Scenes as text in a test -> files in that test's own folder -> scenes or the text of their errors.
#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "scene/load.h"

namespace carom {

inline std::string test_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::string folder = testing::TempDir() + "carom_scene_" + std::to_string(getpid()) + "_" +
                             info->test_suite_name() + "." + info->name();
  std::filesystem::create_directories(folder);
  return folder;
}

/// In a folder of the running test.
inline std::string write_file(std::string_view text, const std::string& name = "scene.yaml") {
  const std::string path = test_folder() + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

inline Scene load_text(std::string_view text, const LoadOptions& options = {}) {
  const std::string path = write_file(text);
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
inline std::string errors_of(std::string_view text, const LoadOptions& options = {}) {
  const std::string folder = test_folder() + "/";
  try {
    load_text(text, options);
    return "";
  } catch (const SceneError& error) {
    std::string out = error.what();
    for (std::size_t i = out.find(folder); i != std::string::npos; i = out.find(folder, i)) out.erase(i, folder.size());
    return out;
  }
}

inline std::string errors_with(std::string_view text, const std::string& set) {
  LoadOptions options;
  options.set = {set};
  return errors_of(text, options);
}

/// A scene that is complete except for the test's part.
inline const std::string start = "scene: 1\nsimulate: {duration: 1}\n";

}  // namespace carom
