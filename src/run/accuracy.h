#pragma once
// How far a scene's run can be trusted: which steps meet its tolerance, until when, and whether its motion is chaotic.
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "physics/state.h"
#include "physics/world.h"
#include "run/engine.h"
#include "scene/simulate_settings.h"

namespace carom {

struct Scene;

/// What a run is to be carried with so that places are right to a tolerance.
struct Accuracy {
  StepChoice steps;       // of engine stepped
  double difference = 0;  // m: the greatest of its places from those of a finer run, as long as these are known
  // s: from when on places are not known to the tolerance, by whatever steps; infinity: they are to the end.
  double right_until = std::numeric_limits<double>::infinity();
  double beyond = 0;    // m: by how much the finest runs differ then
  bool reached = true;  // until then the tolerance is met
};

/// Of dop853: runs of ever smaller step errors, until one agrees with a finer one, which is taken. Of a method with
/// steps of one length: steps are halved until a run agrees with dop853's. Of engine exact: what rounding does. Finer
/// runs begin disturbed by rounding (perturbed()), so that runs agree by accident nowhere. `way`: its engine is exact
/// or stepped. `look` is called between slices of the runs, and may throw. Throws SimulationError.
Accuracy settle_accuracy(const Scene& scene, const Simulate& way, double tolerance, const std::function<void()>& look);

/// Carries a disturbance of 1e-12 along (Benettin, Galgani, Giorgilli & Strelcyn, Meccanica 15 (1980) 9). The motion
/// is chaotic where it grows faster than the third power of time all along, until it is as large as bodies are.
Growth growth_of(const Scene& scene, const Simulate& way, const StepChoice& steps, const std::function<void()>& look);

/// The expected error of a run, by what it consists of.
struct Assessment {
  double tolerance = 0;  // m: the scene's, or a hundredth of its smallest radius
  double right_until = std::numeric_limits<double>::infinity();  // s: places are right to it; infinity: to the end
  double rounding = 0;                 // m: by how much a disturbance by rounding moves places
  std::optional<double> integrator{};  // m: between two accuracies of steps; none: paths have closed forms
  double stepped_contact = 0;          // s, summed over bodies
  double method_error = 0;             // J, that lasting contact took beside impacts
  Growth growth;
};

/// Of runs of this scene by `engine`, with its steps settled. Throws as settle_accuracy().
Assessment assess(const Scene& scene, const EngineChoice& engine, const std::function<void()>& look);

/// A scene's World and state with velocities, masses and gravity off by up to `share` of themselves, each differently.
/// What rests or touches stays as it is.
struct Perturbed {
  World world;
  State initial;
};
Perturbed perturbed(const World& world, const State& initial, double share);

}  // namespace carom
