#pragma once
// The choice of simulator and steps for a scene, with the reason. The table in engine.cpp makes each simulator.

#include "physics/watched_impulse.h"
#include "scene/engines.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct World;

struct Scene;

/// The steps of the stepped engine, and of islands.
struct StepChoice {
  /// In s. For dop853 the longest step. None: determined by the forces, or adaptive.
  optional<double> length{};
  /// For dop853 and islands, the error of each step, as a share of a radius and of speeds. 0: the default.
  double error = 0;
  /// dop853 also follows paths that have closed forms, as a method independent of these.
  bool numerical = false;
  /// Impacts of one instant act one after the other, the fastest first. It shows what the choice of their law changes.
  bool one_by_one = false;
  friend bool operator==(const StepChoice&, const StepChoice&) = default;
};

/// The growth of a small perturbation of a motion.
struct Growth {
  bool chaotic = false;
  /// In s, the time of e-fold growth. Infinity: regular motion.
  double lyapunov_time = infinity;
  double factor = 1;  // the greatest growth
  /// In s, the time at which it is as large as the bodies. Infinity: never.
  double large_at = infinity;
};

struct EngineChoice {
  Engine engine = Engine::exact;  // never automatic
  /// One line: the reason for this engine, and its steps.
  string why{};
  /// Empty for a scene with a tolerance, until settle_steps finds them.
  StepChoice steps{};
  // The following are of a scene with a tolerance.
  /// How the tolerance is missed. Empty: it is met.
  string shortfall{};
  /// In s, until when it is met. Infinity: to the end.
  double right_until = infinity;
  /// If it is not met to the end.
  Growth growth{};

  void keep(auto& archive) { archive(engine, why, steps, shortfall, right_until, growth); }
};

/// The engine of the scene, or the choice of `auto` (scene/engines.h).
EngineChoice choose_engine(const Scene& scene);

/// The settings with another engine and integrator, and without a step or tolerance.
Simulate with_engine(Simulate simulate, Engine engine, Integrator integrator = Integrator::rk4);

/// Throws SimulationError if the scene's output has flights and its engine records no paths.
/// The loader refuses that too, but the command line may choose other outputs.
void check_flights(const Scene& scene);

/// What a simulator records besides its state.
struct Recording {
  bool collisions = false;
  bool paths = false;
  vector<WatchedQuantity> watch{};    // for Simulator::extremes()
  vector<WatchedImpulse> impulses{};  // for Simulator::impulses()
};

/// The scene's simulator at time 0. `scene` must outlive it. Throws SimulationError.
/// `steps`: the settled ones. If empty, those of the scene, or the default.
unique_ptr<Simulator> make_simulator(const Scene& scene, Recording recording = {}, const StepChoice& steps = {});

/// The same from any state of any world. Both must outlive the simulator.
unique_ptr<Simulator> make_simulator(const World& world, const State& initial, const Simulate& simulate,
                                     Recording recording = {}, const StepChoice& steps = {});

/// The most exact engine for the world, whatever engine the scene names.
Engine most_exact(const World& world);

/// A simulator by that engine which records collisions, to find the true first event. Throws SimulationError.
/// `paths`: it also records these.
unique_ptr<Simulator> make_oracle(const Scene& scene, bool paths = false);

}  // namespace carom
