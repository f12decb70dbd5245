#pragma once
// A piece of a body's path as it is recorded: with the pieces of all bodies the state at any instant is known again,
// bit for bit, without simulating.
#include "numerics/compensated.h"
#include "numerics/vec3.h"
#include "physics/entity.h"

namespace carom {

/// By how much a velocity is not that of a parabola, t after its start: t (linear + t quadratic).
struct PathBend {
  Vec3 linear = Vec3::Zero();     // m/s^2
  Vec3 quadratic = Vec3::Zero();  // m/s^3
  bool none() const { return linear.isZero(0) && quadratic.isZero(0); }
  Vec3 at(double t) const { return t * (linear + t * quadratic); }  // m/s
};

/// From `from` on, until the body's next piece, its position is x + t (v + t a / 2) and its velocity v + t a, where t
/// is the time since `start`, less (until - now) kick where there is any, and t (linear + t quadratic)
/// more where contact bends it.
struct PathPiece {
  Entity body = no_entity;
  double from = 0;              // s, the first double at which it holds
  DoubleDouble start{0, 0};     // s
  Vec3 x = Vec3::Zero();        // m, at start
  Vec3 v = Vec3::Zero();        // m/s, at start
  Vec3 a = Vec3::Zero();        // m/s^2
  bool kicked = false;          // by a time step: what forces do until its end is in v from the start
  DoubleDouble until{0, 0};     // s, that end
  Vec3 kick = Vec3::Zero();     // m/s^2
  PathBend bend{};              // in contact with what is curved
  Entity part_of = no_entity;   // the body that it has become part of, by whose pieces it moves
  bool joint = false;           // others have become part of it: it now has the
  double mass = 0, radius = 0;  // kg, m,
  Vec3 half = Vec3::Zero();     // m, half extents of its volume
};

}  // namespace carom
