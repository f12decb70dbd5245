#pragma once
// One picture of a motion.
#include <functional>
#include <memory>
#include <string>

#include "render/image.h"
#include "simulate/simulator.h"

namespace carom {

struct Scene;

/// The scene at `time` (s, within its duration), as a frame shows it, or without frames its film. `run`: the
/// name of its folder. `motion` makes a simulator of the scene at time 0 that records what the pictures show.
/// `stop_check` is called often, and may throw. Throws SimulationError, RenderError.
Image draw_still(const Scene& scene, const std::string& run, double time,
                 const std::function<std::unique_ptr<Simulator>()>& motion, const std::function<void()>& stop_check);

}  // namespace carom
