#pragma once
// Bodies on strings and rods, for tests.

#include "simulate/build.h"
#include "std.h"

namespace carom {

struct Tied : Problem {
  Tied() { world.gravity = Vec3(0, -g_n, 0); }
  String& anchored(Entity body, const Vec3& anchor, double length) {
    world.strings.push_back({body, no_entity, anchor, length});
    return world.strings.back();
  }
  String& between(Entity body, Entity other, double length) {
    world.strings.push_back({body, other, Vec3::Zero(), length});
    return world.strings.back();
  }
};

/// The period of a pendulum (s) that swings out to `angle` (rad), by the arithmetic-geometric mean.
inline double period(double length, double angle, double gravity = g_n) {
  double a = 1, b = std::cos(angle / 2);
  for (int k = 0; k < 8; ++k) {
    const double mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return 2 * M_PI * sqrt(length / gravity) / a;
}

inline Tied pendulum(double angle, double length, bool rod = false) {
  Tied problem;
  const Vec3 x(length * std::sin(angle), -length * std::cos(angle), 0);
  const Entity bob = problem.ball(x, {0, 0, 0}, 2, 0.05);
  problem.anchored(bob, {0, 0, 0}, x.norm()).rod = rod;
  return problem;
}

}  // namespace carom
