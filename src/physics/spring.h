#pragma once
// F = -(k (|d| - l) + c d|d|/dt) d/|d|, d = x - anchor: a spring with a damper beside it, both along the line from the
// anchor. At the anchor the damper acts along the body's velocity. A spring with a rest length has no direction there,
// and does not push.

#include "physics/particle.h"
#include "std.h"

namespace carom {

struct Spring {
  static constexpr const char* name = "spring";  // in scenes
  static constexpr bool constant = false;
  Vec3 anchor = Vec3::Zero();  // m
  double stiffness = 0;        // N/m, k
  double rest_length = 0;      // m, l
  double damping = 0;          // kg/s, c

  static constexpr bool bends() { return true; }
  bool closed() const { return rest_length == 0 && damping == 0; }
  bool damps() const { return damping > 0; }
  static constexpr double fade() { return 0; }
  static constexpr double reach(const Vec3&) { return everywhere; }
  Vec3 acceleration(const Particle& p) const {
    const Vec3 d = p.x - anchor;
    if (closed()) return -stiffness / p.mass * d;
    const double length = d.norm();
    if (length == 0) return -damping / p.mass * p.v;
    // A single factor times d: where the factor is great, rounding leaves no force across the line.
    return (stiffness * (rest_length - length) - damping / length * d.dot(p.v)) / (length * p.mass) * d;
  }
  double potential(const Particle& p) const {
    const Vec3 d = p.x - anchor;
    if (rest_length == 0) return 0.5 * stiffness * d.squaredNorm();
    const double stretch = d.norm() - rest_length;
    return 0.5 * stiffness * stretch * stretch;
  }
  Vec3 drain(const Particle& p) const { return damper(p, p.x - anchor) / p.mass; }
  double rate(const Particle& p) const { return sqrt(stiffness / p.mass) + damping / p.mass; }
  friend bool operator==(const Spring&, const Spring&) = default;

 private:
  Vec3 damper(const Particle& p, const Vec3& d) const {
    const double square = d.squaredNorm();
    if (damping == 0 || square == 0) return -damping * p.v;
    // Along the line alone, as above.
    return -damping * d.dot(p.v) / square * d;
  }
};

}  // namespace carom
