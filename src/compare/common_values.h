#pragma once
// The values that the scenes of many runs have in common, found with one scene in memory.

#include "compare/compared_run.h"
#include "scene/scene_values.h"
#include "std.h"

namespace carom {

class CommonValues {
 public:
  /// Reads the run's scene.yaml.
  void add(const RunRecord& run);
  /// The values common to all scenes so far. None if their texts differ in more than values.
  vector<SceneValue> values() const;

 private:
  void compare(string_view other);

  string folder_, text_;  // of the first run
  vector<bool> same_;     // by byte of text_
};

}  // namespace carom
