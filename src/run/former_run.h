#pragma once
// A finished run in a folder, to be drawn again or plotted without simulating it.

#include "files/manifest.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct FormerRun {
  string folder;
  Manifest manifest;
  /// From its scene.yaml, with the outputs that the folder has.
  Scene scene;
  /// The bodies that have rows in its trajectory.csv, by its `on`. Empty: all have.
  string in_table;

  /// The file of this name in its manifest, or the compressed one of a table. Null: none.
  const FileRecord* find(string_view file) const;
  bool has(string_view file) const { return find(file) != nullptr; }
  /// Whether the run stored the paths of its bodies (export/flights_file.h).
  bool has_flights() const;
  /// The same, with its collisions (drawings_show_collisions), and their impulses if they sound. `drawn`: the scene to
  /// draw, of the same motion, perhaps of another look. Throws ExportError if the file is damaged.
  bool has_flights_with_collisions(const Scene& drawn) const;
  /// When it ended (s), by its summary.csv. Throws ExportError.
  double read_end_time() const;
  /// A simulator that follows these paths. `drawn` must have the same motion and outlive it.
  /// Throws ExportError, also later while it advances.
  unique_ptr<Simulator> replay(const Scene& drawn) const;
};

/// Whether a file of the run may be missing or changed.
using SparedFile = function<bool(const FormerRun& run, string_view name)>;

/// The run in `folder`, of this version of the program. `file`: its scene.yaml, from which the scene is read.
/// It must be complete, except for the files that are `spared`.
/// Throws SceneError, and ExportError with a text that names the remedy.
FormerRun read_former_run(const string& folder, SceneFile& file, const SparedFile& spared);

/// The path of a run's scene.yaml. Throws ExportError if the folder cannot be that of a complete run.
string former_scene_file(const string& folder);

}  // namespace carom
