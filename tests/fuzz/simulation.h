#pragma once
// Invariants of every run of every scene that the loader accepts, by any engine.

#include "scene/scene.h"
#include "std.h"

namespace carom::fuzz {

struct Outcome {
  vector<string> violations;  // empty: all is well
  string engine;
  string stopped;  // the error that ended it, as it may
  uint64_t collisions = 0;
  uint64_t hash = 0;  // of all records and states, to the last bit
};

/// Runs the scene. `patience`: its limit of CPU time, s.
Outcome simulate(const Scene& scene, double patience);

}  // namespace carom::fuzz
