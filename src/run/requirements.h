#pragma once
// What the outputs of a scene need of this machine besides carom: programs, a font, OSMesa, and the textures of meshes.

#include "scene/load.h"
#include "std.h"

namespace carom {

/// Outputs need something that is missing. The scene itself may be right.
struct RequirementError : SceneError {
  explicit RequirementError(const SceneError& error) : SceneError(error) {}
};

class Requirements {
 public:
  /// Throws RequirementError with all that is missing to make these outputs. `file`: the scene's, with this scene as
  /// its last one. Textures are decoded as for a picture. Each mesh is read once, whatever the number of scenes.
  void check(const SceneFile& file, const Scene& scene, const Output& outputs);

 private:
  const string& fault_of_colors(const string& mesh);

  map<string, string> faults_;  // by mesh; empty: its colours can be read
};

}  // namespace carom
