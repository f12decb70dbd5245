#pragma once
// F = -(k (|d| - l) + c d|d|/dt) d/|d| on body b, d = x_b - x_a, and the opposite on body a: a spring between two
// bodies with a damper beside it. Where the two are at one point a spring with a rest length has no direction, and does
// not push.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct BodySpring {
  Entity a = no_entity;
  Entity b = no_entity;
  double stiffness = 0;     // N/m, k
  double rest_length = 0;   // m, l
  double damping = 0;       // kg/s, c
  double from = 0;          // s, when it sets in
  double until = infinity;  // s, when it ceases

  /// Whether the force is smooth where the two are at one point.
  bool is_smooth() const { return rest_length == 0 && damping == 0; }
  bool acts(double time) const { return from <= time && time < until; }
  /// Whether it has a potential. A force that starts or ends does work instead.
  bool acts_for_ever() const { return from == 0 && until == infinity; }
  /// The force on b (N), for b's position (m) and velocity (m/s) less those of a.
  Vec3 force(const Vec3& d, const Vec3& w) const {
    if (is_smooth()) return -stiffness * d;
    const double length = d.norm();
    if (length == 0) return -damping * w;
    return (stiffness * (rest_length - length) - damping / length * d.dot(w)) / length * d;
  }
  /// The part of it that has no potential (N).
  Vec3 drain(const Vec3& d, const Vec3& w) const {
    if (!acts_for_ever()) return force(d, w);
    const double square = d.squaredNorm();
    if (damping == 0 || square == 0) return -damping * w;
    return -damping * d.dot(w) / square * d;
  }
  /// J; 0 unless it acts for ever.
  double potential(const Vec3& d) const {
    if (!acts_for_ever()) return 0;
    const double stretch = rest_length == 0 ? 0 : d.norm() - rest_length;
    return 0.5 * stiffness * (rest_length == 0 ? d.squaredNorm() : stretch * stretch);
  }
};

}  // namespace carom
