#pragma once
// F = -G m_a m_b d / (|d|^2 + s^2)^(3/2) on body b, d = x_b - x_a, and the opposite on body a: bodies attract each
// other, softened (Plummer 1911) by s.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct Gravitation {
  double constant = 0;      // m^3/(kg s^2), G; negative: they repel each other
  double softening = 0;     // m, s
  double from = 0;          // s, when it sets in
  double until = infinity;  // s, when it ceases
  vector<Entity> on{};      // ascending; empty: all bodies

  bool acts(double time) const { return from <= time && time < until; }
  /// Whether it has a potential. A force that starts or ends does work instead.
  bool acts_for_ever() const { return from == 0 && until == infinity; }
  /// J; 0 unless it acts for ever. masses: kg^2, the product of both. d: m, from one to the other.
  double potential(double masses, const Vec3& d) const {
    return acts_for_ever() ? -constant * masses / sqrt(d.squaredNorm() + softening * softening) : 0;
  }
};

}  // namespace carom
