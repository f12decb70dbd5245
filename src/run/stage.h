#pragma once
// One folder of a run in the making: its exports, and the pictures that they are due.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "export/exports.h"
#include "render/renderer.h"
#include "simulate/simulator.h"

namespace carom {

struct Manifest;
struct Scene;

/// What is to be seen of a motion, and where it is written. Scenes that share a motion differ in their pictures and
/// outputs alone.
struct Show {
  const Scene* scene = nullptr;
  std::string folder;
  double load_s = 0;                  // what reading the scene took, for the manifest
  const Manifest* renewed = nullptr;  // of the run in the folder, whose pictures this replaces (exports.h)
};

/// What is called between pictures; both may throw.
struct StageWatch {
  std::function<void()> look, tell;
};

class Stage {
 public:
  /// Opens the folder. Throws ExportError.
  Stage(const Show& show, Durability durability);

  double time() { return exports.timeline().time(); }  // s, of its next instant

  /// Writes and draws what is due at the next instant, which is the simulator's time. Throws ExportError, RenderError.
  void sample(Simulator& simulator, const StageWatch& watch);

  const Scene& scene;
  RunFacts facts;
  Exports exports;
  bool more = false;  // whether there is a next instant

 private:
  void draw_what_is_due(const State& state, const StageWatch& watch);

  std::vector<std::unique_ptr<Renderer>> renderers_;  // by picture stream
};

}  // namespace carom
