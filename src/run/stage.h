#pragma once
// One output folder during a run: its exports, and the pictures that are due for them.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "export/exports.h"
#include "overlay/history.h"
#include "render/moving_camera.h"
#include "run/measuring.h"
#include "run/picture_series.h"
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
  SceneOrigin origin{};  // for the manifest
};

/// Functions called between pictures. Both may throw.
struct StageWatch {
  std::function<void()> stop_check, report_progress;
};

class Stage {
 public:
  /// Opens the folder, and takes these measures. Throws ExportError, RenderError.
  Stage(const Show& show, Durability durability, std::vector<Measure> measures);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// The cameras of what is drawn. Those that frame the motion must have been given it before the first sample.
  std::vector<MovingCamera*> cameras();

  double time();  // s, of its next instant

  /// Takes what the simulator has recorded since the last call.
  void record(const Simulator& simulator);
  /// Ends its timeline at `time` (s), the run's end, which is after all instants that are done. Throws ExportError.
  void end_at(double time);

  /// Writes and draws what is due at the next instant, which must be the simulator's time.
  /// Throws ExportError, RenderError.
  void sample(Simulator& simulator, const StageWatch& watch);

  const Scene& scene;
  RunFacts facts;
  Measuring measuring;
  Exports exports;
  bool more = false;  // whether a next instant exists

 private:
  void aim();
  bool is_picture_due(std::size_t stream);
  bool needs_state(double time);
  void expose(std::size_t stream, const State& state, const StageWatch& watch);
  void draw(std::size_t stream, Simulator& simulator, const StageWatch& watch);

  History history_;
  std::vector<PictureSeries> series_;  // by picture stream
  MovingCamera of_model_;              // of gltf
};

}  // namespace carom
