#pragma once
// YAML to a checked Scene, or errors that point at the character.

#include "scene/load_options.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

/// All errors of a scene file, as text for a terminal.
/// Each has file:line:column, the line, a caret and the remedy.
struct SceneError : runtime_error {
  SceneError(const Diagnostics& diagnostics, bool color)
      : SceneError(diagnostics.text(color), diagnostics.count(), diagnostics.records()) {}
  SceneError(const string& text, size_t errors, vector<ErrorRecord> parts)
      : runtime_error(text), count(errors), records(std::move(parts)) {}
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
