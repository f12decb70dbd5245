#pragma once
// F = const.
#include "physics/particle.h"

namespace carom {

struct UniformForce {
  static constexpr const char* name = "uniform";  // in scenes
  static constexpr bool constant = true;
  Vec3 force;  // N

  static constexpr bool bends() { return false; }
  static constexpr bool closed() { return true; }
  static constexpr bool damps() { return false; }
  static constexpr double fade() { return 0; }
  static constexpr double reach(const Vec3&) { return everywhere; }
  Vec3 acceleration(const Particle& p) const { return force / p.mass; }
  double potential(const Particle& p) const { return -force.dot(p.x); }
  Vec3 drain(const Particle&) const { return Vec3::Zero(); }
  double rate(const Particle&) const { return 0; }
  friend bool operator==(const UniformForce&, const UniformForce&) = default;
};

}  // namespace carom
