#pragma once
// Which simulator a scene runs on.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "scene/scene.h"
#include "simulate/simulator.h"

namespace carom {

struct EngineChoice {
  std::string name;  // "exact", "stepped", "book"; as in summary.csv
  std::string why;   // one line: why this one, and with which steps
  // s, of engine stepped; none: the scene's tolerance is to tell, by settle_step, or steps are chosen as the run goes
  std::optional<double> step{};
};

EngineChoice choose_engine(const Scene& scene);

const char* name_of(Engine engine);          // as in scene files
const char* name_of(Integrator integrator);  // "euler", "verlet", "rk4", "dop853"; as in scene files

/// A scene's settings with another engine, integrator and step (s; none: the default).
Simulate with_engine(Simulate simulate, Engine engine, Integrator integrator = Integrator::rk4,
                     std::optional<double> step = {});

/// Finds the step of engine stepped where the scene asks for a tolerance, by running it again and again. `look` is
/// called now and then, and may throw. Throws SimulationError.
void settle_step(const Scene& scene, EngineChoice& engine, const std::function<void()>& look);

/// Throws SimulationError if the scene's output has flights and its engine records no paths. (The loader refuses that
/// too; outputs may be chosen by the command line.)
void check_flights(const Scene& scene);

/// The scene's simulator at time 0. `scene` must outlive it. `step`: as settled; else the scene's own, or the default.
/// `record_paths`: where paths are parabolas (scene/unsupported.h); else paths() stays empty. Throws SimulationError.
std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions, std::optional<double> step = {},
                                          bool record_paths = false);

/// The simulator that `simulate` names (its engine: not automatic), from any state of any world on; both must outlive
/// it. Without a step of its own: the default. Throws SimulationError.
std::unique_ptr<Simulator> make_simulator(const World& world, const State& initial, const Simulate& simulate,
                                          bool record_collisions, bool record_paths = false);

/// The most exact simulator that there is for the scene, whatever engine it asks for: what really happens first.
std::unique_ptr<Simulator> make_oracle(const Scene& scene);

}  // namespace carom
