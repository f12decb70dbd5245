#pragma once
// The effect of a collision: an impulse along the normal. The tangential velocity stays (frictionless spheres; chapter
// 8).

#include "numerics/vec3.h"
#include "physics/collision.h"
#include "physics/world.h"
#include "std.h"

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
  return world.is_body(e) ? world.mass[e] : infinity;
}

/// What an impact on this thing is.
inline CollisionKind impact_kind(const World& world, Entity thing) {
  return world.is_body(thing)     ? CollisionKind::body_body
         : world.is_string(thing) ? CollisionKind::taut
                                  : CollisionKind::body_fixed;
}

/// Completes the record of an impact on a body or a fixed thing: the masses give its impulse and the energy lost.
inline Collision with_effect(const World& world, Collision met) {
  const double ma = world.mass[met.a], mb = impact_mass(world, met.b);
  met.impulse = impact_impulse(ma, mb, met.approach_speed, met.separation_speed);
  met.energy_lost = impact_loss(ma, mb, met.approach_speed, met.separation_speed);
  return met;
}

}  // namespace carom
