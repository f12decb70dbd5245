#pragma once
// A path through a step as a polynomial of degree 8 in s = t / length: the dense output of a method. It is the integral
// of that of the velocity, so that place, velocity and the acceleration at the start are of one motion.
#include <array>
#include <cstddef>

#include "numerics/vec3.h"

namespace carom {

struct PolynomialPath {
  static constexpr std::size_t terms = 8;
  using Terms = std::array<Vec3, terms>;  // by s, s^2, ...

  double length = 0;          // s
  bool is_parabola = false;   // no term beyond the second
  Terms displacement;         // m, since the start
  Vec3 ahead = Vec3::Zero();  // m/s: what a method's velocities are behind the path's

  Vec3 displacement_at(double t) const { return value(displacement, t / length); }
  Vec3 change_at(double t) const { return slope_change(displacement, t / length) / length; }  // m/s, of the velocity
  Vec3 acceleration(double t) const { return bend(displacement, t / length) / (length * length); }  // m/s^2
  /// m/s^2: at least the greatest acceleration on the way.
  double greatest_acceleration() const;

  /// Through a step of `length` (s) from velocity v (m/s) and acceleration a (m/s^2) on: the parabola,
  static PolynomialPath parabola(double length, const Vec3& v, const Vec3& a);
  /// or Hermite's polynomial of degree 5, that ends `bend` (m) off the straight line, with a velocity that has changed
  /// by `change` (m/s) and acceleration end_a (m/s^2).
  static PolynomialPath through(double length, const Vec3& v, const Vec3& a, const Vec3& bend, const Vec3& change,
                                const Vec3& end_a);

  /// A path's velocity (m/s), acceleration (m/s^2) and jerk (m/s^3) at one place.
  struct Point {
    Vec3 velocity, acceleration, jerk;
  };
  /// Or the integral of Hermite's polynomial of degree 7 for the velocity: with all of that at a step's start and end,
  /// and velocity and acceleration in the middle.
  static PolynomialPath through(double length, const Point& start, const Point& middle, const Point& end);

  static Vec3 value(const Terms& of, double s);
  static Vec3 slope(const Terms& of, double s) { return of[0] + slope_change(of, s); }
  static Vec3 slope_change(const Terms& of, double s);  // of the slope since s = 0
  static Vec3 bend(const Terms& of, double s);          // the second derivative
  /// What a path's displacement is from s = `from` on, in parts of `length` (as s).
  static Terms shifted(const Terms& of, double from, double length);
};

}  // namespace carom
