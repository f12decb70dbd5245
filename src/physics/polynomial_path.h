#pragma once
// A path through a step as a polynomial of degree 8 in s = t / length: the dense output of a method of order 8, or less.
// It is the integral of that of the velocity, so that place, velocity and the acceleration at both ends are of one
// motion. Semi-implicit Euler's has two: in a step of any length a kick of h a goes with a drift of h^2 a.
#include <array>
#include <cstddef>

#include "physics/vec3.h"

namespace carom {

struct PolynomialPath {
  static constexpr std::size_t terms = 8;
  using Terms = std::array<Vec3, terms>;  // by s, s^2, ...

  double length = 0;   // s
  Terms displacement;  // m, since the start
  double share = 1;    // of the change of the path's slope that the velocity has

  Vec3 displacement_at(double t) const { return value(displacement, t / length); }
  Vec3 slope_at(double t) const { return slope(displacement, t / length) / length; }  // m/s, of the path
  Vec3 change_at(double t) const {                                                     // m/s, of the velocity
    return share / length * slope_change(displacement, t / length);
  }
  Vec3 acceleration(double t) const { return bend(displacement, t / length) / (length * length); }  // m/s^2, the path's
  /// m/s^2: at least the greatest of the path's accelerations.
  double greatest_acceleration() const;

  /// Paths through a step of `length` (s) from velocity v (m/s) on that end `bend` (m) off the straight line:
  /// by semi-implicit Euler,
  static PolynomialPath of_euler(double length, const Vec3& v, const Vec3& bend);
  /// with a velocity that has changed by `change` (m/s): Hermite's cubic,
  static PolynomialPath cubic(double length, const Vec3& v, const Vec3& bend, const Vec3& change);
  /// from acceleration a to end_a (m/s^2) besides: Hermite's quintic.
  static PolynomialPath quintic(double length, const Vec3& v, const Vec3& a, const Vec3& bend, const Vec3& change,
                                const Vec3& end_a);

  static Vec3 value(const Terms& of, double s);
  static Vec3 slope(const Terms& of, double s) { return of[0] + slope_change(of, s); }
  static Vec3 slope_change(const Terms& of, double s);  // of the slope since s = 0
  static Vec3 bend(const Terms& of, double s);          // the second derivative
  /// What a path's displacement is from s = `from` on, in parts of `length` (as s).
  static Terms shifted(const Terms& of, double from, double length);
};

}  // namespace carom
