#pragma once
// What the caller decides about loading a scene, and its readers of other files.

#include "scene/budget.h"
#include "scene/former_state.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

struct LoadOptions {
  vector<string> set;       // "path=value", in order
  optional<uint64_t> seed;  // overrides the file's
  Budget budget;
  /// Whether the caller chooses among the outputs. One that the scene cannot have is then no error of the file.
  bool chooses_outputs = false;
  bool color = false;  // colour in the texts of errors

  /// Reads the vertices of a mesh file, in the file's own units.
  /// Throws runtime_error with a text that describes the fault of the file. Unset: scenes with meshes are refused.
  function<vector<Vec3>(const string& path)> mesh_points;
  /// Reads the state of a run's bodies. `folder`: relative to the working folder. `at`: s of the run; none: its end.
  /// Throws StartError. Unset: scenes with `start` are refused.
  function<FormerState(const string& folder, optional<double> at)> former_state;
  /// The fault of a measure that the scene defines; an empty text: none. Unset: measures are not checked.
  function<TextFault(const Scene& scene, const OwnMeasure& measure)> measure_fault;
};

}  // namespace carom
