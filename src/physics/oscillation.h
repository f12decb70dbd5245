#pragma once
// Motion under linear springs of rest length 0, linear drag and constant forces, the same along every axis:
// x'' = a - stiffness (x - x(0)) - fade x'. Only + - * / and the square root reach the result.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The effect by t (s) of a unit of velocity and of a unit of acceleration at t = 0.
struct Response {
  double displaced;  // s: S, of S'' + fade S' + stiffness S = 0 with S(0) = 0, S'(0) = 1
  double kept;       // S'
  double bent;       // s^2: the integral of S over [0, t]
};

/// Valid for fade >= 0 (1/s), stiffness > 0 (1/s^2) and t >= 0 (s), each below 1e150.
Response response(double fade, double stiffness, double t);

/// A path from its start on.
struct Oscillation {
  Vec3 x = Vec3::Zero();  // m, at t = 0
  Vec3 v = Vec3::Zero();  // m/s, at t = 0
  Vec3 a = Vec3::Zero();  // m/s^2: the acceleration of a particle at rest at x
  double fade = 0;        // 1/s, >= 0
  double stiffness = 1;   // 1/s^2, > 0: spring constants over mass

  void keep(auto& archive) { archive(x, v, a, fade, stiffness); }

  void at(double t, Vec3& position, Vec3& velocity) const;
  /// Acceleration (m/s^2) and jerk (m/s^3) at t (s). They are not computed from forces, which cancel where the motion
  /// fades.
  void bend(double t, Vec3& acceleration, Vec3& jerk) const;
};

}  // namespace carom
