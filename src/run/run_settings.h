#pragma once
// What a run is asked for besides its scene, how it reports, and what it returns.
#include <exception>

#include "engine/engine.h"
#include "files/publication.h"
#include "files/summary.h"
#include "run/measure.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct Manifest;
struct Scene;

struct RunProgress {
  /// settling: short runs find the steps for a tolerance.
  enum class Phase { settling, simulating, drawing, writing };
  Phase phase = Phase::simulating;
  double time = 0;          // s, simulated
  uint64_t collisions = 0;  // so far
  uint64_t pictures = 0;    // drawn, of all shows
  double begun_at = 0;      // s, simulated by the interrupted run that this one continues
  uint64_t planned = 0;     // pictures, drawn or not, as far as is known
};

struct RunWatch {
  /// Called often, by any thread. May throw.
  function<void()> stop_check;
  /// Called often by the caller's thread.
  function<void(const RunProgress&)> report_progress;
  /// Called with what is worth knowing before the end.
  function<void(const string&)> remark = [](const string&) {};
};

struct RunSettings {
  Durability durability = Durability::synced;
  /// A run is kept so often (s, wall time), so that an interrupted one goes on from there. 0: never.
  double checkpoint_s = 60;
  /// Measures for the manifest, besides those of the scenes.
  vector<Measure> measures{};
  /// The manifest of a former run with this motion, which supplies warnings and measures. Null: there is none.
  const Manifest* former = nullptr;
  /// Makes simulators of a recorded motion, in place of a simulation. May be unset.
  function<unique_ptr<Simulator>(const Scene&)> replay{};
  /// Makes the simulator of a simulation.
  function<unique_ptr<Simulator>(const Scene&, Recording, const StepChoice&)> simulator =
      [](const Scene& scene, Recording recording, const StepChoice& steps) {
        return make_simulator(scene, std::move(recording), steps);
      };
};

struct RunResult {
  Summary summary;
  RunFacts facts;
  EngineChoice engine{};  // with its steps settled
  /// The whole run, including finishing the files, and the simulation by an interrupted run that it has continued.
  double wall_s = 0;
  /// The error of this show alone: RenderError or ExportError. If it is set, all other members are meaningless.
  std::exception_ptr failure{};
};

}  // namespace carom
