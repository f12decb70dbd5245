#pragma once
// a = const, for every mass.
#include "physics/particle.h"

namespace carom {

struct UniformAcceleration {
  static constexpr const char* name = "acceleration";  // in scenes
  static constexpr bool constant = true;
  Vec3 value;  // m/s^2

  static constexpr bool bends() { return false; }
  static constexpr bool closed() { return true; }
  static constexpr bool damps() { return false; }
  static constexpr double fade() { return 0; }
  static constexpr double reach(const Vec3&) { return everywhere; }
  Vec3 acceleration(const Particle&) const { return value; }
  double potential(const Particle& p) const { return -p.mass * value.dot(p.x); }
  Vec3 drain(const Particle&) const { return Vec3::Zero(); }
  double rate(const Particle&) const { return 0; }
  friend bool operator==(const UniformAcceleration&, const UniformAcceleration&) = default;
};

}  // namespace carom
