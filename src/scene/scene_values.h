#pragma once
// A scene file as a list of paths and values, to hold two scenes against each other.
#include <cstddef>
#include <string>
#include <vector>

namespace carom {

struct SceneValue {
  std::string path;        // as --set takes it: "balls.red.position.z", "forces.0.acceleration.x"
  std::string text;        // a number with its shortest digits, any other value as it stands
  std::string unit;        // "m"; empty: none
  std::size_t offset = 0;  // bytes from the text's start to where the value stands
};

/// All values of a scene file's text, in its order, defaults not filled in. `name`: the file's, for errors. Throws
/// SceneError where the text is no YAML.
std::vector<SceneValue> scene_values(const std::string& name, const std::string& text);

}  // namespace carom
