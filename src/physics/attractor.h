#pragma once
// a = -mu d / (|d|^2 + s^2)^(3/2), d = x - center: gravity of a point mass, softened (Plummer 1911) by s.

#include "physics/particle.h"
#include "std.h"

namespace carom {

struct Attractor {
  static constexpr const char* name = "attractor";  // in scenes
  static constexpr bool constant = false;
  Vec3 center = Vec3::Zero();  // m
  double strength = 0;         // m^3/s^2, mu; negative: it repels
  double softening = 0;        // m, s

  static constexpr bool bends() { return true; }
  bool closed() const { return softening == 0 || strength == 0; }
  static constexpr bool damps() { return false; }
  static constexpr double fade() { return 0; }
  double reach(const Vec3& x) const { return sqrt((x - center).squaredNorm() + softening * softening); }
  Vec3 acceleration(const Particle& p) const {
    const double square = distance_squared(p);
    return -strength / (square * sqrt(square)) * (p.x - center);
  }
  double potential(const Particle& p) const { return -strength * p.mass / sqrt(distance_squared(p)); }
  Vec3 drain(const Particle&) const { return Vec3::Zero(); }
  // The rate of a circular orbit at this distance plus that of passing by, 1/s.
  double rate(const Particle& p) const {
    const double square = distance_squared(p);
    return sqrt(std::abs(strength) / (square * sqrt(square))) + p.v.norm() / sqrt(square);
  }
  friend bool operator==(const Attractor&, const Attractor&) = default;

 private:
  double distance_squared(const Particle& p) const { return (p.x - center).squaredNorm() + softening * softening; }
};

}  // namespace carom
