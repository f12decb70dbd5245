#pragma once
// Which simulator a scene runs on, with which steps, and why. The table in engine.cpp makes each of them.
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "scene/engines.h"
#include "simulate/simulator.h"

namespace carom {

struct World;

struct Scene;
struct State;

/// Of engine stepped.
struct StepChoice {
  std::optional<double> length{};  // s: of dop853 the longest; none: by the forces, or as the run goes
  double error = 0;                // of dop853, of a radius and of speeds in each; 0: the default
  bool numerical = false;          // dop853 follows paths that have closed forms too: a way independent of these
  friend bool operator==(const StepChoice&, const StepChoice&) = default;
};

/// How a small disturbance of a motion grows.
struct Growth {
  bool chaotic = false;
  double lyapunov_time = std::numeric_limits<double>::infinity();  // s, in which it grows e-fold; infinity: regular
  double factor = 1;                                               // by which it has grown at most
  double large_at = std::numeric_limits<double>::infinity();  // s, when it is as large as bodies are; infinity: never
};

struct EngineChoice {
  Engine engine = Engine::exact;  // not automatic
  std::string why{};              // one line: why this one, and with which steps
  StepChoice steps{};             // but where the scene has a tolerance: then settle_steps finds them
  // Of a scene with a tolerance:
  std::string shortfall{};                                       // how it is not met; empty: it is
  double right_until = std::numeric_limits<double>::infinity();  // s, until when it is; infinity: to the end
  Growth growth{};                                               // where it is not
};

/// The scene's own, or what `auto` stands for (scene/engines.h).
EngineChoice choose_engine(const Scene& scene);

/// A scene's settings with another engine and integrator, and without a step or tolerance.
Simulate with_engine(Simulate simulate, Engine engine, Integrator integrator = Integrator::rk4);

/// Where the scene asks for a tolerance: finds the steps that meet it, by running it again and again (accuracy.h), or
/// by how much it is not met. `look` is called now and then, and may throw. Throws SimulationError.
void settle_steps(const Scene& scene, EngineChoice& engine, const std::function<void()>& look);

/// Throws SimulationError if the scene's output has flights and its engine records no paths. (The loader refuses that
/// too; outputs may be chosen by the command line.)
void check_flights(const Scene& scene);

/// What a simulator records beside its state.
struct Recording {
  bool collisions = false;
  bool paths = false;  // where they are parabolas (scene/engines.h); else Simulator::paths() stays empty
};

/// The scene's simulator at time 0. `scene` must outlive it. `steps`: as settled; else the scene's own, or the default.
/// Throws SimulationError.
std::unique_ptr<Simulator> make_simulator(const Scene& scene, Recording recording = {}, const StepChoice& steps = {});

/// The same from any state of any world on; both must outlive it.
std::unique_ptr<Simulator> make_simulator(const World& world, const State& initial, const Simulate& simulate,
                                          Recording recording = {}, const StepChoice& steps = {});

/// The most exact engine that there is for the world, whatever engine the scene names.
Engine most_exact(const World& world);

/// A simulator by it, which records collisions: what really happens first. Throws SimulationError.
std::unique_ptr<Simulator> make_oracle(const Scene& scene);

}  // namespace carom
