#pragma once
// A collision that happened. A predicted one is an Event, which is private to a simulator.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

enum class CollisionKind : uint8_t {
  body_body,   // two bodies struck each other
  body_fixed,  // a body struck a fixed surface
  rest,        // a body's bounces on a surface ended; from here on it rests or slides
  merge,       // two bodies became one
  // A string went taut; a: its body, b: the string. The point is the centre of a, and the normal points from the other
  // end of the string to a.
  taut
};

struct Collision {
  double time;  // s
  CollisionKind kind;
  Entity a;                 // the body with the lower number, or the only one
  Entity b;                 // the other body, the fixed surface or the string
  Vec3 position;            // m, the point of contact
  Vec3 normal;              // unit, from a to b
  double approach_speed;    // m/s, along the normal, > 0: approaching
  double separation_speed;  // m/s, along the normal, > 0: separating
  double restitution;       // the pair's coefficient
  double impulse = 0;       // N s, along the normal
  double energy_lost = 0;   // J, < 0: made

  void keep(auto& archive) {
    archive(time, kind, a, b, position, normal, approach_speed, separation_speed, restitution, impulse, energy_lost);
  }
};

}  // namespace carom
