// The resolved scene of every scene, as another YAML reader takes it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "scene/load.h"
#include "scenes/play.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

/// Words that readers of YAML 1.1 take for flags, and numbers that they take for text.
const string hostile = R"yaml(
scene: 1
title: "off"
let: {n: 1e-9, yes: -.5}
gravity: [0, -.5, 1e3]
balls:
  y: {mass: 1e2, radius: 0.1, position: [0, 1, 1e-9]}
  no: {mass: .5, radius: .1, position: [1, 1, 0]}
planes: {on: {point: [0, 0, 0], normal: [0, 1, 0]}}
forces: [{uniform: [1e-3, 0, 0], on: [y, no]}]
restitution: {pairs: [{between: [y, on], value: 5e-1}]}
simulate: {duration: 1}
measures: {Yes: "hits(y, on)"
}
output: {trajectory: {every: 1e-1, on: [no]}, tables: {separator: ";", decimal: ","}}
)yaml";

TEST(ResolvedScenes, AreReadAlikeByPyYaml) {
  string folder = ::testing::TempDir() + "carom_resolved_XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  std::ofstream(folder + "/hostile.yaml") << hostile;

  std::ofstream lines(folder + "/scenes");
  const auto add = [&](const string& name, const Scene& scene) {
    const nlohmann::ordered_json line = {
        {"name", name}, {"text", scene.resolved}, {"values", json_of_yaml(scene.resolved)}};
    lines << line.dump() << "\n";
  };

  for (const string& name : scene_names()) add(name, load(name));
  const Scene scene = load_scene(folder + "/hostile.yaml");
  add("hostile", scene);
  lines.close();
  EXPECT_NE(scene.resolved.find("\n  \"y\": {mass: 1.0e+2, radius: 0.1, position: [0, 1, 1.0e-9]"), string::npos)
      << scene.resolved;

  const string command = "/usr/bin/python3 " SOURCE_DIR "/tests/scenes/read_resolved.py " + folder + "/scenes > " +
                         folder + "/out 2> " + folder + "/err";
  const int code = std::system(command.c_str());
  std::ifstream errors(folder + "/err");
  EXPECT_EQ(code, 0) << errors.rdbuf();
  fs::remove_all(folder);
}

}  // namespace
}  // namespace carom::testing
