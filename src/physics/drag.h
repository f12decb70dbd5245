#pragma once
// F = -(c + q |u|) u, u = v - wind: linear (Stokes) and quadratic (Newton) drag of a medium in motion.

#include "physics/particle.h"
#include "std.h"

namespace carom {

struct Drag {
  static constexpr const char* name = "drag";  // in scenes
  static constexpr bool constant = false;
  double linear = 0;         // kg/s, c
  double quadratic = 0;      // kg/m, q
  Vec3 wind = Vec3::Zero();  // m/s, the medium's velocity

  bool bends() const { return quadratic != 0; }
  bool closed() const { return quadratic == 0; }
  static constexpr bool damps() { return true; }
  double fade() const { return linear; }
  static constexpr double reach(const Vec3&) { return everywhere; }
  Vec3 acceleration(const Particle& p) const {
    const Vec3 u = p.v - wind;
    const double factor = quadratic == 0 ? linear : linear + quadratic * u.norm();
    return -factor / p.mass * u;
  }
  double potential(const Particle&) const { return 0; }
  Vec3 drain(const Particle& p) const { return acceleration(p); }
  double rate(const Particle& p) const { return (linear + 2 * quadratic * (p.v - wind).norm()) / p.mass; }
  friend bool operator==(const Drag&, const Drag&) = default;
};

}  // namespace carom
