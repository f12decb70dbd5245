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
  // The same in pieces of paths (physics/path_piece.h), of all bodies.
  double piece_rate = 0;
  double landing_pieces = 0;
};

/// None, from `never` on, by an engine without crowds, of few bodies, of bodies that merge, without gravity towards
/// fixed surfaces, or where impacts take no energy.
CrowdAhead crowd_ahead(const Scene& scene, Engine engine);

/// The time (s) that a simulation takes from `time` to `duration` (s), where it takes `rate` for a second at present.
double time_ahead(const CrowdAhead& crowd, double time, double duration, double rate);

/// The pieces of paths that a simulation records from `time` to `duration` (s): those that events begin, at `rate` for
/// a second at present and as bodies land, and those of the steps of the crowd.
struct PiecesAhead {
  double of_events = 0;
  double of_crowd = 0;
};
PiecesAhead pieces_ahead(const CrowdAhead& crowd, double time, double duration, double rate);

}  // namespace carom
