#pragma once
// A piece of a body's path, as it is recorded. The pieces of all bodies reproduce the state at any instant, bit for
// bit, without simulation.
#include <memory>

#include "numerics/compensated.h"
#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"

namespace carom {

/// A piece holds from `from` until the body's next piece. With t the time since `start`, the position is x + t (v + t a
/// / 2) and the velocity v + t a. A kicked piece has (until - time) kick less velocity. Contact with curved surfaces
/// and with strings bends a piece to a polynomial.
struct PathPiece {
  Entity body = no_entity;
  double from = 0;           // s, the first double at which it holds
  DoubleDouble start{0, 0};  // s
  Vec3 x = Vec3::Zero();     // m, at start
  Vec3 v = Vec3::Zero();     // m/s, at start
  Vec3 a = Vec3::Zero();     // m/s^2
  // In a crowd v is the velocity of the step's middle, `until`, from the start on.
  bool kicked = false;
  DoubleDouble until{0, 0};  // s, the middle of that step
  Vec3 kick = Vec3::Zero();  // m/s^2
  // The displacement since start, until the next piece. None: a parabola.
  std::shared_ptr<const PolynomialPath> curve{};
  // The body that it has become part of. The pieces of that body give its motion.
  Entity part_of = no_entity;
  bool removed = false;  // it has left the world
  // Other bodies have become part of it. Its mass, radius and half extents are then the following.
  bool joint = false;
  double mass = 0, radius = 0;  // kg, m
  Vec3 half = Vec3::Zero();     // m, half extents of the volume
};

}  // namespace carom
