#pragma once
// One checked scene -> its folder: joins simulator, timeline, renderers and exports.
#include <string>

#include "commands/progress.h"
#include "export/exports.h"
#include "study/engine.h"

namespace carom {

struct RunResult {
  Summary summary;
  RunFacts facts;
  EngineChoice engine{};  // with its step settled
  double wall_s = 0;      // all of it, finishing the files included
};

/// Simulates, draws and writes. Throws SimulationError, RenderError, ExportError or Interrupted; then nothing that is
/// not whole stays in `folder`. `load_s`: what reading the scene took, for the manifest.
RunResult run_scene(const Scene& scene, const EngineChoice& engine, const std::string& folder, double load_s,
                    Progress& progress);

}  // namespace carom
