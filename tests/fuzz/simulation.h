#pragma once
// Invariants of every run of every scene that the loader accepts, by any engine.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom::fuzz {

struct Outcome {
  std::vector<std::string> violations;  // empty: all is well
  std::string engine;
  std::string stopped;  // the error that ended it, as it may
  std::uint64_t collisions = 0;
  std::uint64_t hash = 0;  // of all records and states, to the last bit
};

/// Runs the scene. `patience`: its limit of CPU time, s.
Outcome simulate(const Scene& scene, double patience);

}  // namespace carom::fuzz
