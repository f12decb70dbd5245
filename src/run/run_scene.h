#pragma once
// Runs checked scenes into their folders: joins simulator, timelines, renderers and exports.
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "run/engine.h"
#include "run/measure.h"
#include "run/stage.h"

namespace carom {

struct Manifest;
struct Scene;

struct RunWatch {
  /// Called often, by any thread. May throw.
  std::function<void()> stop_check;
  /// Reports progress: simulated time (s), collisions, pictures of all shows. Called by the caller's thread.
  std::function<void(double time, std::uint64_t collisions, std::uint64_t pictures)> report_progress;
};

struct RunSettings {
  Durability durability = Durability::synced;
  /// Measures for the manifest, besides those of the scenes.
  std::vector<Measure> measures{};
  /// The manifest of a former run with this motion, which supplies warnings and measures. Null: there is none.
  const Manifest* former = nullptr;
  /// Makes simulators of a recorded motion, in place of a simulation. May be unset.
  std::function<std::unique_ptr<Simulator>(const Scene&)> replay{};
  /// Makes the simulator of a simulation.
  std::function<std::unique_ptr<Simulator>(const Scene&, Recording, const StepChoice&)> simulator =
      [](const Scene& scene, Recording recording, const StepChoice& steps) {
        return make_simulator(scene, std::move(recording), steps);
      };
};

struct RunResult {
  Summary summary;
  RunFacts facts;
  EngineChoice engine{};  // with its steps settled
  /// The whole run, including finishing the files.
  double wall_s = 0;
  /// The error of this show alone: RenderError or ExportError. If it is set, all other members are meaningless.
  std::exception_ptr failure{};
};

/// Simulates once, writes the tables of each show on the way, and draws from the record of the motion.
/// Throws SimulationError, what `watch.stop_check` throws, and, for a single show, its failure.
/// Then only complete files stay.
std::vector<RunResult> run_shows(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings,
                                 const RunWatch& watch);

/// The same for one scene.
RunResult run_scene(const Show& show, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch);

}  // namespace carom
