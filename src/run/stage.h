#pragma once
// One output folder during a run: its exports, and the pictures that are due for them.
#include <functional>
#include <string>
#include <vector>

#include "export/exports.h"
#include "render/moving_camera.h"
#include "run/shot.h"
#include "simulate/simulator.h"

namespace carom {

struct Manifest;
struct Scene;

/// What to show of a motion, and the folder for it.
/// Scenes that share a motion differ only in their pictures and outputs.
struct Show {
  const Scene* scene = nullptr;
  std::string folder;
  /// Wall time of loading the scene, for the manifest.
  double load_s = 0;
  /// The manifest of the run in the folder, if only its pictures are replaced (exports.h).
  const Manifest* renewed = nullptr;
};

/// Functions called between pictures. Both may throw.
struct StageWatch {
  std::function<void()> stop_check, report_progress;
};

class Stage {
 public:
  /// Opens the folder. Throws ExportError.
  Stage(const Show& show, Durability durability);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// The cameras of what is drawn. Those that frame the motion must have been given it before the first sample.
  std::vector<MovingCamera*> cameras();

  double time() { return exports.timeline().time(); }  // s, of its next instant

  /// Writes and draws what is due at the next instant, which must be the simulator's time.
  /// Throws ExportError, RenderError.
  void sample(Simulator& simulator, const StageWatch& watch);

  const Scene& scene;
  RunFacts facts;
  Exports exports;
  bool more = false;  // whether a next instant exists

 private:
  void draw_what_is_due(const State& state, const StageWatch& watch);

  std::vector<Shot> shots_;  // by picture stream
  MovingCamera of_model_;    // of gltf
};

}  // namespace carom
