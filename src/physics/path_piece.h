#pragma once
// A piece of a body's path, as it is recorded. The pieces of all bodies reproduce the state at any instant, bit for
// bit, without simulation.

#include "numerics/compensated.h"
#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

/// What gives a piece its motion.
enum class PathLaw : uint8_t {
  constant,  // a parabola, or the curve of a method's step
  verlet,    // the same, with the velocities of Verlet's method: v + t (a at t - a) / 2
  closed,    // springs or an attractor in closed form, from x and v at start on (closed_motion.h)
  frame      // a straight line, but x itself until start plus or minus `rounding`
};

/// A piece holds from `from` until the body's next piece. With t the time since `start`, the position is x + t (v + t a
/// / 2) and the velocity v + t a. A kicked piece has (until - time) kick less velocity. Contact with curved surfaces
/// and with strings, and forces without a closed form, bend a piece to a polynomial.
struct PathPiece {
  Entity body = no_entity;
  double from = 0;           // s, the first double at which it holds
  DoubleDouble start{0, 0};  // s
  Vec3 x = Vec3::Zero();     // m, at start
  Vec3 v = Vec3::Zero();     // m/s, at start
  Vec3 a = Vec3::Zero();     // m/s^2
  double fade = 0;           // 1/s: by linear drag a decays at this rate (fading_path.h)
  PathLaw law = PathLaw::constant;
  double rounding = 0;  // s, of a frame
  // In a crowd v is the velocity of the step's middle, `until`, from the start on.
  bool kicked = false;
  DoubleDouble until{0, 0};  // s, the middle of that step
  Vec3 kick = Vec3::Zero();  // m/s^2
  // The displacement since start, until the next piece, and its velocity ahead of the method's. None: a parabola.
  shared_ptr<const PolynomialPath> curve{};
  // The body that it has become part of. The pieces of that body give its motion.
  Entity part_of = no_entity;
  bool removed = false;  // it has left the world, or has yet to come
  // Other bodies have become part of it. Its mass, radius and half extents are then the following.
  bool joint = false;
  double mass = 0, radius = 0;  // kg, m
  Vec3 half = Vec3::Zero();     // m, half extents of the volume

  void keep(auto& archive) {
    archive(body, from, start, x, v, a, fade, law, rounding, kicked, until, kick, curve);
    archive(part_of, removed, joint, mass, radius, half);
  }
};

}  // namespace carom
