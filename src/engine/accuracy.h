#pragma once
// The accuracy of a scene's run: the steps that meet its tolerance, until when they do,
// and whether the motion is chaotic.

#include "engine/engine.h"
#include "physics/state.h"
#include "physics/world.h"
#include "scene/simulate_settings.h"
#include "std.h"

namespace carom {

struct Scene;

/// In s: instants between two times, at irrational fractions, which no period of a scene matches. The fewer, the more
/// bodies there are, so that their places take little memory.
vector<double> uneven_instants(double from, double to, size_t bodies);

/// For a scene with a tolerance, finds the steps with which positions are within it. If there are none, determines by
/// how much it is missed.
/// - dop853: runs with ever smaller step errors, until one agrees with a finer one, which is then used.
/// - integrators of fixed steps: steps are halved until a run agrees with that of dop853.
/// - exact engine: the effect of rounding is measured. Where the paths of islands have no closed form, it proceeds as
///   with dop853.
/// Finer runs start with a perturbation of the size of rounding (perturbed()), so that no two runs agree by accident.
/// `stop_check` is called between slices of the runs, and may throw. Throws SimulationError.
void settle_steps(const Scene& scene, EngineChoice& engine, const function<void()>& stop_check);

/// Carries a perturbation of 1e-12, and of places by rounding, along (Benettin, Galgani, Giorgilli & Strelcyn,
/// Meccanica 15 (1980) 9). The motion is chaotic if the perturbation grows faster than the third power of time all
/// along. Growth is measured until the perturbation is as large as the bodies.
Growth growth_of(const Scene& scene, const Simulate& way, const StepChoice& steps, const function<void()>& stop_check);

/// The expected error of a run, split by its causes.
struct Assessment {
  /// In m: the scene's, or a hundredth of its smallest radius.
  double tolerance = 0;
  /// In s: the time until which positions are within the tolerance. Infinity: to the end.
  double right_until = infinity;
  /// In m: the effect of a perturbation by rounding on positions.
  double rounding = 0;
  /// In m: the difference of two accuracies of steps. None: all paths have closed forms. NaN: not known, because a
  /// smaller error of each step changes nothing, as where positions are rounded by more.
  optional<double> integrator{};
  /// In m: the difference of a run in which impacts of one instant act one after the other. None: rigid bodies leave
  /// none of them open.
  optional<double> order{};
  double stepped_contact = 0;  // s, summed over bodies
  double method_error = 0;     // J: energy that lasting contact removed, besides impacts
  Growth growth;
};

/// Assesses runs of this scene by `engine`, which must have its steps settled. Throws as settle_steps() does.
Assessment assess(const Scene& scene, const EngineChoice& engine, const function<void()>& stop_check);

/// A scene's World and state with velocities, masses and gravity changed by up to `share` of themselves,
/// each differently, and all places by the rounding of their coordinates.
/// Bodies at rest or in contact stay so, within what a start allows for rounding. Equal coordinates stay equal.
struct Perturbed {
  World world;
  State initial;
};
Perturbed perturbed(const World& world, const State& initial, double share);

}  // namespace carom
