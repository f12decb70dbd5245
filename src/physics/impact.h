#pragma once
// The effect of a collision: an impulse along the normal. The tangential velocity stays (frictionless spheres; chapter
// 8).
#include <limits>

#include "numerics/vec3.h"
#include "physics/collision.h"
#include "physics/world.h"

namespace carom {

/// The impulse (N s) between two masses (kg) that approach at `approach` (m/s) and separate at `separation` (m/s): J =
/// (approach + separation) m1 m2 / (m1 + m2). With separation = e approach this is the chapter's v1' = ((m1 - e m2) v1
/// + (1 + e) m2 v2) / (m1 + m2).
inline double impact_impulse(double m1, double m2, double approach, double separation) {
  return (approach + separation) / (1 / m1 + 1 / m2);
}

/// The kinetic energy lost (J): mu (approach^2 - separation^2) / 2. Negative: energy is made.
inline double impact_loss(double m1, double m2, double approach, double separation) {
  return 0.5 * (approach - separation) * (approach + separation) / (1 / m1 + 1 / m2);
}

/// Mass (kg); infinite for fixed things.
inline double impact_mass(const World& world, Entity e) {
  return world.is_body(e) ? world.mass[e] : std::numeric_limits<double>::infinity();
}

/// The record of an impact of body a on b, a body or a fixed thing, at `time` (s). The masses give its impulse and the
/// energy lost. Units: `point` m, `approach` and `separation` m/s along the normal. `normal` is unit, from a to b;
/// `restitution` is the pair's coefficient.
inline Collision make_collision(const World& world, CollisionKind kind, double time, Entity a, Entity b,
                                const Vec3& point, const Vec3& normal, double approach, double separation,
                                double restitution) {
  const double ma = world.mass[a], mb = impact_mass(world, b);
  return {time,
          kind,
          a,
          b,
          point,
          normal,
          approach,
          separation,
          restitution,
          impact_impulse(ma, mb, approach, separation),
          impact_loss(ma, mb, approach, separation)};
}

}  // namespace carom
