#pragma once
// YAML to a checked Scene, or errors that point at the character.
#include <stdexcept>

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
  /// Throws std::runtime_error with a text that describes the fault of the file. Unset: scenes with meshes are refused.
  function<vector<Vec3>(const string& path)> mesh_points;
  /// Reads the state of a run's bodies. `folder`: relative to the working folder. `at`: s of the run; none: its end.
  /// Throws StartError. Unset: scenes with `start` are refused.
  function<FormerState(const string& folder, optional<double> at)> former_state;
  /// The fault of a measure that the scene defines; an empty text: none. Unset: measures are not checked.
  function<TextFault(const Scene& scene, const OwnMeasure& measure)> measure_fault;
};

/// All errors of a scene file, as text for a terminal.
/// Each has file:line:column, the line, a caret and the remedy.
struct SceneError : std::runtime_error {
  SceneError(const Diagnostics& diagnostics, bool color)
      : SceneError(diagnostics.text(color), diagnostics.count(), diagnostics.records()) {}
  SceneError(const string& text, size_t errors, vector<ErrorRecord> parts)
      : std::runtime_error(text), count(errors), records(std::move(parts)) {}
  size_t count;
  /// The errors in parts, as far as the text shows them.
  vector<ErrorRecord> records;
};

/// A fault of a loaded scene that its text does not show.
struct SceneFault {
  optional<Place> place;  // none: of the scene as a whole
  string fault, remedy;
};

/// A change to a scene: one --set option.
struct Setting {
  string text;  // "path=value"
  /// The place shown in errors: "falls.yaml:7:3". Empty: "--set path=value".
  string where;
};

/// A scene file, read once and resolved with a different setting each time.
class SceneFile {
 public:
  /// Reads and parses the file. Throws SceneError, as all functions of this class do.
  SceneFile(const string& path, const LoadOptions& options);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;

  /// The scene with these settings, applied after those of the options. The result is checked and resolved.
  Scene scene(const vector<Setting>& settings = {});
  /// The error of these faults of the last scene.
  SceneError error(const vector<SceneFault>& faults) const;
  /// The file's text, without byte order mark and carriage returns.
  const string& text() const;

 private:
  struct Impl;
  unique_ptr<Impl> impl_;
};

/// Reads, checks and resolves one scene file. Throws SceneError, which holds every error of the file.
Scene load_scene(const string& path, const LoadOptions& options = {});

}  // namespace carom
