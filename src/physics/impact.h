#pragma once
// What a collision does: impulses along the normal, tangential velocity kept (frictionless spheres; chapter 8).
#include "physics/vec3.h"

namespace carom {

/// The impulse (N s) that two masses (kg) approaching at `approach` (m/s) exchange so that they separate at
/// `separation`: J = (approach + separation) m1 m2 / (m1 + m2). With separation = e approach this is the chapter's v1'
/// = ((m1 - e m2) v1 + (1 + e) m2 v2) / (m1 + m2).
inline double impact_impulse(double m1, double m2, double approach, double separation) {
  return (approach + separation) / (1 / m1 + 1 / m2);
}

/// Kinetic energy (J) that goes: mu (approach^2 - separation^2) / 2. Negative: it is made.
inline double impact_loss(double m1, double m2, double approach, double separation) {
  return 0.5 * (approach - separation) * (approach + separation) / (1 / m1 + 1 / m2);
}

}  // namespace carom
