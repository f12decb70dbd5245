#pragma once
// Which step a scene needs for an error asked for.
#include <functional>
#include <limits>

#include "simulate/exact.h"

namespace carom {

struct StepChoice {
  double step;  // s
  double
      difference;  // m: by how much a run with it differs from one with twice the step, anywhere at any time looked at
  // s: from when on runs differ by more than was asked for however short the step; infinity: they do not.
  double chaotic_from = std::numeric_limits<double>::infinity();
};

/// Halves the step until two runs agree within `tolerance` (m) in every body's position, at the end and at 63 instants
/// before, and gives the shorter one. Where that does not come about, or no longer as steps get shorter, the scene is
/// chaotic: then the step with which it agrees the longest. options.step counts for nothing. `look` is called between
/// slices of the runs, and may throw. Throws SimulationError if no step gives a run.
StepChoice choose_step(const World& world, const State& initial, ExactOptions options, double tolerance,
                       const std::function<void()>& look);

}  // namespace carom
