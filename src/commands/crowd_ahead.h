#pragma once
// When the bodies of a scene will lie in heaps, which take a simulator far more time than their fall.
#include "geometry/contact_time.h"
#include "scene/simulate_settings.h"

namespace carom {

struct Scene;

/// From `from` to `until` (s) bodies move as a crowd (simulate/crowd/crowd_motion.h). Before, they fly; afterwards they
/// rest. A guess from the heights from which they fall, and from what impacts take.
struct CrowdAhead {
  double from = never;
  double until = never;
  double rate = 0;     // s of CPU time for a simulated second
  double landing = 0;  // s of CPU time, of the impacts that come before
};

/// None, from `never` on, by an engine without crowds, of few bodies, of bodies that merge, without gravity towards
/// fixed surfaces, or where impacts take no energy.
CrowdAhead crowd_ahead(const Scene& scene, Engine engine);

/// The time (s) that a simulation takes from `time` to `duration` (s), where it takes `rate` for a second at present.
double time_ahead(const CrowdAhead& crowd, double time, double duration, double rate);

}  // namespace carom
