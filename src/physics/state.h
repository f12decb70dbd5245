#pragma once
// What changes during a run: where the bodies are and how they move, at one instant.
#include <vector>

#include "physics/vec3.h"

namespace carom {

struct State {
  double time = 0;             // s
  std::vector<Vec3> position;  // m, of the centre, by body
  std::vector<Vec3> velocity;  // m/s, by body
};

}  // namespace carom
