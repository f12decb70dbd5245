#pragma once
// A run that is there already, whose motion is to be seen again.
#include <memory>
#include <string>

#include "files/manifest.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/simulator.h"

namespace carom {

struct FormerRun {
  std::string folder;
  Manifest manifest;
  Scene scene;  // of its scene.yaml; its outputs: those that the folder has

  /// Whether it stored the paths of its bodies (export/flights_file.h).
  bool has_flights() const;
  /// Along these paths. `scene`, of the same motion, must outlive it. Throws ExportError, then and as it goes on.
  std::unique_ptr<Simulator> motion(const Scene& scene) const;
};

/// The run in `folder`, where it is whole but for its pictures, and this version's; its scene is read by `file`, that
/// of its scene.yaml. Throws ExportError, whose text says what to do, and SceneError.
FormerRun read_former_run(const std::string& folder, SceneFile& file);

/// The path of a run's scene.yaml. Throws ExportError where the folder cannot be that of a whole run.
std::string former_scene_file(const std::string& folder);

}  // namespace carom
