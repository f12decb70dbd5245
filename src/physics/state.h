#pragma once
// What changes during a run: the positions and velocities of the bodies at one instant.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/volume.h"
#include "std.h"

namespace carom {

struct State {
  double time = 0;        // s
  vector<Vec3> position;  // m, of the centre, by body
  vector<Vec3> velocity;  // m/s, by body

  // These are empty where all bodies are in the world, and none has merged. A merged body keeps its own mass and radius
  // in the World. Here its mass is zero, and its position and velocity are those of the joint body.
  vector<double> mass{};    // kg, by body
  vector<double> radius{};  // m, by body: radius of the smallest sphere about the volume
  vector<Volume> volume{};  // by body
  // The body that it is part of; its own number: none; no_entity: it is out of the world: it has left it, or has
  // yet to come.
  vector<Entity> part_of{};

  // s, by trigger of the World: the first double after its event; not_yet: that lies ahead. Empty: there are none.
  vector<double> fired{};

  /// Brings all fields to the form above.
  /// Before, part_of may name a body that has itself become part of another, and the rest is as it was before the
  /// merges.
  void join_parts();
};

}  // namespace carom
