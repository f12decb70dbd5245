#pragma once
// A scene file as a list of paths and values, for comparing two scenes.

#include "scene/output.h"
#include "std.h"

namespace carom {

struct Node;

/// A number with its shortest digits, any other value as written.
string text_of_value(const Node& node);

struct SceneValue {
  string path;  // as --set takes it: "balls.red.position.z", "forces.0.acceleration.x"
  /// A number with its shortest digits, any other value as written.
  string text;
  string unit;  // "m"; empty: none
  /// Bytes, from the start of the text to the value.
  size_t offset = 0;
};

/// The names of the measures that a scene file's text defines. None if the text is not YAML.
vector<string> own_measure_names(const string& text);

/// The text of a resolved scene without the line of `output.tables`: how tables are written is no property of a run.
string without_tables(string text);

/// The separator and the decimal mark that a scene file's text chooses for its tables. Those of a new struct if it is
/// not YAML.
TablesOutput own_tables(const string& text);

/// All values of a scene file's text, in its order, without defaults. `name`: the file's name, for errors.
/// Throws SceneError if the text is not YAML.
vector<SceneValue> scene_values(const string& name, const string& text);

}  // namespace carom
