#pragma once
// Checked scenes -> their folders: joins simulator, timelines, renderers and exports.
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/engine.h"
#include "run/stage.h"

namespace carom {

struct Scene;

struct RunWatch {
  std::function<void()> look;  // called often; may throw
  /// How far it is: simulated time (s), collisions, pictures of all shows.
  std::function<void(double time, std::uint64_t collisions, std::uint64_t pictures)> tell;
};

struct RunSettings {
  Durability durability = Durability::synced;
  /// What else the manifest says of a run's end; may be unset.
  std::function<std::vector<Measured>(const Scene&, const State& end, const Summary&)> measure;
  /// Of a former run whose motion this is: what it warned of. Unset: found anew.
  std::optional<std::vector<Warning>> warnings{};
  /// What goes along the motion in place of the scene's engine; may be unset.
  std::function<std::unique_ptr<Simulator>(const Scene&)> simulator{};
};

struct RunResult {
  Summary summary;
  RunFacts facts;
  EngineChoice engine{};         // with its step settled
  double wall_s = 0;             // all of it, finishing the files included
  std::exception_ptr failure{};  // of this show alone: RenderError, ExportError; then the rest of this means nothing
};

/// Simulates once, draws and writes each show. Throws SimulationError, what `watch.look` throws, and for a single show
/// its failure; then nothing that is not whole stays in the folders.
std::vector<RunResult> run_shows(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings,
                                 const RunWatch& watch);

/// The same for one scene.
RunResult run_scene(const Show& show, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch);

}  // namespace carom
