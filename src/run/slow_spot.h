#pragma once
// Where a film of the scene slows down, by its motion.

#include "scene/film_clock.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct Scene;

/// The first collision of the requested bodies in the time that the film shows, and how slow it is there. None: there
/// is none. `motion` makes simulators of the scene at time 0 that record collisions, and is called twice. `stop_check`
/// is called often, and may throw.
optional<Slowdown> find_slowdown(const Scene& scene, const function<unique_ptr<Simulator>()>& motion,
                                 const function<void()>& stop_check);

}  // namespace carom
