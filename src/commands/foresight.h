#pragma once
// Simulates the beginning of a scene: the first collision, the bodies that enter and leave the picture, and the time a
// run takes.

#include "commands/crowd_ahead.h"
#include "engine/engine.h"
#include "physics/collision.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

class MovingCamera;
struct Scene;

/// A body enters or leaves the picture between the previous instant and this one.
struct ViewChange {
  Entity body;
  double time;  // s
  bool enters;
};

/// A fixed thing hides most of a body in the picture, at each watched instant of a time.
struct Hiding {
  Entity body, behind;
  double from, until;  // s, the first and the last of these instants
};

struct Foresight {
  optional<Collision> first;                   // none: no collision within the duration
  string trouble;                              // why the first collision is unknown; empty: it is known
  string failure;                              // what stops a run later, as far as was simulated; empty: nothing
  vector<ViewChange> crossings;                // in order of time
  vector<Hiding> hidings;                      // in order of their ends, those to the end of what is watched last
  double watched_from = 0, watched_until = 0;  // s: crossings are known in between
  double every = 0;                            // s between the watched instants; 0: there were none
  bool cut = false;                            // the simulation ended before the pictures
  optional<double> simulate_s;                 // approximate wall time of the whole simulation; none: unknown
  PiecesAhead pieces;                          // roughly those of the whole motion, if flights are requested
};

/// Simulates by the most exact engine, whatever the scene names, for `budget` (s), and until the first collision for at
/// most 20 times that; then by the scene's own engine, if it is another, for `budget`. `camera`: of the crossings;
/// null: none are sought.
Foresight foresee(const Scene& scene, const EngineChoice& engine, const MovingCamera* camera, double budget);

/// Frames the motion by the most exact engine, if the camera does that. False: it takes longer than `budget` (s), or
/// the simulation fails.
bool frame_motion(MovingCamera& camera, double budget);

}  // namespace carom
