#pragma once
// A path through a step as a polynomial of degree 8 in s = t / length: the dense output of a method.
// It is the integral of the velocity's polynomial, so that position, velocity and the acceleration at the start belong
// to one motion.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct PolynomialPath {
  static constexpr size_t terms = 8;
  using Terms = array<Vec3, terms>;  // in s, s^2, ...

  double length = 0;         // s
  bool is_parabola = false;  // no term beyond the second
  Terms displacement;        // m, since the start
  // m/s: the velocities of the method less those of the path.
  Vec3 ahead = Vec3::Zero();

  Vec3 displacement_at(double t) const { return value(displacement, t / length); }
  // Change of the velocity since the start, m/s.
  Vec3 change_at(double t) const { return slope_change(displacement, t / length) / length; }
  Vec3 acceleration(double t) const { return bend(displacement, t / length) / (length * length); }  // m/s^2
  /// An upper bound of the acceleration along the path (m/s^2).
  double greatest_acceleration() const;

  /// The parabola through a step of `length` (s) from velocity v (m/s) and acceleration a (m/s^2).
  static PolynomialPath parabola(double length, const Vec3& v, const Vec3& a);
  /// Hermite's polynomial of degree 5 through such a step. It ends `bend` (m) off the straight line, with acceleration
  /// end_a (m/s^2). The velocity has then changed by `change` (m/s).
  static PolynomialPath through(double length, const Vec3& v, const Vec3& a, const Vec3& bend, const Vec3& change,
                                const Vec3& end_a);

  /// The velocity (m/s), acceleration (m/s^2) and jerk (m/s^3) of a path at one instant.
  struct Point {
    Vec3 velocity, acceleration, jerk;
  };
  /// The integral of Hermite's polynomial of degree 7 for the velocity.
  /// It takes all three values at a step's start and end, and velocity and acceleration in the middle.
  static PolynomialPath through(double length, const Point& start, const Point& middle, const Point& end);

  void keep(auto& archive) { archive(length, is_parabola, displacement, ahead); }

  static Vec3 value(const Terms& of, double s);
  static Vec3 slope(const Terms& of, double s) { return of[0] + slope_change(of, s); }
  // The change of the slope since s = 0.
  static Vec3 slope_change(const Terms& of, double s);
  static Vec3 bend(const Terms& of, double s);  // the second derivative
  /// The displacement from s = `from` on, as a polynomial in parts of `length` (measured in s).
  static Terms shifted(const Terms& of, double from, double length);
};

}  // namespace carom
