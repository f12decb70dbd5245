#pragma once
// A motion seen in advance, for the cameras that frame it.
#include <functional>
#include <span>

#include "render/moving_camera.h"
#include "simulate/simulator.h"

namespace carom {

/// Carries the simulator, which is at time 0, over the instants that each camera's scene shows, and frames the motion.
/// All scenes have this motion. A camera of another kind is left as it is. A simulation that fails is framed as far as
/// it goes: the run itself fails there again. `stop_check` is called often, and may throw.
void survey(std::span<MovingCamera* const> cameras, Simulator& simulator, const std::function<void()>& stop_check);

/// Carries the simulator to `time` (s) in pieces, so that `stop_check` is called where nothing happens for long.
/// `duration`: of its motion (s).
void carry_to(Simulator& simulator, double time, double duration, const std::function<void()>& stop_check);

}  // namespace carom
