#pragma once
// Flight under constant forces and linear drag, x'' = pull - fade x'. The path bends towards the velocity pull / fade.
// The acceleration decays as exp(-fade t). Only + - * / reach the result.
#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// Functions of z = fade t >= 0.
struct Fading {
  double gone;   // 1 - exp(-z)
  double bend;   // (z - gone) / z^2 = 1/2! - z/3! + z^2/4! - ...
  double third;  // (1/2 - bend) / z = 1/3! - z/4! + ...
};

Fading fading(double z);

/// The displacement at t (s) that an acceleration of 1 at t = 0 has caused, by t (s).
inline double displaced(double fade, double t) {
  return (fade == 0 ? 0.5 : fading(fade * t).bend) * t;
}
/// The velocity that it has caused (s).
inline double gained(double fade, double t) {
  return fade == 0 ? t : fading(fade * t).gone / fade;
}

/// A path from its start on. With fade = 0 it is a parabola.
struct FadingPath {
  Vec3 x = Vec3::Zero();  // m, at t = 0
  Vec3 v = Vec3::Zero();  // m/s, at t = 0
  Vec3 a = Vec3::Zero();  // m/s^2, at t = 0
  double fade = 0;        // 1/s

  Vec3 position(double t) const { return x + t * (v + displaced(fade, t) * a); }
  Vec3 velocity(double t) const { return v + gained(fade, t) * a; }
  Vec3 acceleration(double t) const;
  /// The same path with its start at time t.
  FadingPath from(double t) const;
  /// The displacement from t on, for `length` (s), as a polynomial in parts of it (m). The length is at most span(t)
  /// (s).
  PolynomialPath::Terms displacement_from(double t, double length) const;
  /// The time (s) from t on for which that is right to rounding. After the acceleration has decayed the path is
  /// straight.
  double span(double t) const { return fade == 0 || fade * t >= 64 ? infinity : 0x1p-4 / fade; }
  /// The integral of the squared speed over [0, t] (m^2/s).
  double squared_speed(double t) const;
};

}  // namespace carom
