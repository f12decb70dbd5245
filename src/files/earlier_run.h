#pragma once
// A run of the same scene file before the file was edited. Such a run may be replaced as long as nothing else is lost.

#include "files/run_folder.h"
#include "files/summary.h"
#include "std.h"

namespace carom {

/// The path of a scene file from a run's folder, both without links, as UTF-8.
/// It stays the same when both are moved together. Throws ExportError if that cannot be determined.
string path_from(const string& folder, const string& scene_file);

struct EarlierRun {
  /// Whether the folder holds a run of this very scene file with these settings, whatever the file's content was.
  bool of_scene = false;
  FolderChanges changes;  // since that run
  bool is_replaceable() const { return of_scene && !changes.any(); }
};

/// Reads the folder and every file that its manifest names. Changes nothing. Throws ExportError.
/// A run of a sweep, and a run by an older version, does not name its scene file. An interrupted one does, if it was
/// kept (checkpoint_file.h).
EarlierRun find_earlier_run(const string& folder, const SceneOrigin& origin);

}  // namespace carom
