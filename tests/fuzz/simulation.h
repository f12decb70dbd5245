#pragma once
// What must hold of every run of every scene that the loader accepts, whatever its engine.
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom::fuzz {

struct Outcome {
  std::vector<std::string> violations;  // empty: all is well
  std::string engine;
  std::string stopped;  // the error that ended it, as it may
  std::uint64_t collisions = 0;
  std::uint64_t hash = 0;  // of all that was recorded and seen, to the last bit
};

/// Runs the scene. `patience`: s of CPU time that it may take.
Outcome simulate(const Scene& scene, double patience);

}  // namespace carom::fuzz
