#pragma once
// One picture of a motion.

#include "render/image.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct Scene;

/// The scene at `time` (s, within its duration), as a frame shows it, or without frames its film. `run`: the
/// name of its folder. `motion` makes a simulator of the scene at time 0 that records what the pictures show.
/// `stop_check` is called often, and may throw. Throws SimulationError, RenderError.
Image draw_still(const Scene& scene, const string& run, double time, const function<unique_ptr<Simulator>()>& motion,
                 const function<void()>& stop_check);

}  // namespace carom
