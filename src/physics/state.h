#pragma once
// What changes during a run: where the bodies are and how they move, at one instant.
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/volume.h"

namespace carom {

struct State {
  double time = 0;             // s
  std::vector<Vec3> position;  // m, of the centre, by body
  std::vector<Vec3> velocity;  // m/s, by body

  // Where bodies have merged (empty: none has). A body that has become part of another keeps its own mass and radius in
  // the World; here it weighs nothing, and its position and velocity are the joint body's.
  std::vector<double> mass{};     // kg, by body
  std::vector<double> radius{};   // m, by body, of the smallest sphere about the volume
  std::vector<Volume> volume{};   // by body
  std::vector<Entity> part_of{};  // the body that it is part of; itself: none

  /// Where part_of names the body that each has merged with, which may have become part of another since, and the rest
  /// is as it was before: brings it all to what is said above.
  void join_parts();
};

}  // namespace carom
