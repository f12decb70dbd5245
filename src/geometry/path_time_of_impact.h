#pragma once
// Times of impact on paths that are not parabolas.
#include "geometry/touch.h"
#include "numerics/polynomial_path.h"
#include "physics/fading_path.h"
#include "std.h"

namespace carom {

/// First t in [0, horizon] at which a and b touch and approach, on paths that linear drag bends. Both paths, pa and pb,
/// start at the same instant. A fixed b has a path that stays at its position. `left`: as in touch.h. Velocities are
/// rounded on the scale of speeds (m/s). The search advances from separating plane to separating plane. Until the path
/// arrives at the plane through the closest points there is no contact, so that none is missed. b is no string.
FeatureTime time_of_impact(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                           double speeds, uint8_t left, double horizon);

/// First t in [0, horizon] at which the distance of two points reaches s (m) from below, on a polynomial path from d
/// (m) on: a string of that length goes taut. just_separated: it has just been taut, and its gap is zero by definition.
double taut_time(const Vec3& d, const PolynomialPath::Terms& displacement, double length, double s, double speeds,
                 bool just_separated, double horizon);

/// The first function for things at xa and xb (m) on polynomial paths. displacement: that of b less that of a (m), by t
/// / length (s).
FeatureTime time_of_impact(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb,
                           const PolynomialPath::Terms& displacement, double length, double speeds, uint8_t left,
                           double horizon);

/// The time at which a pair in lasting contact at this feature arrives at its rim (touch.h), on such paths.
FeatureTime leave_feature(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                          uint8_t feature, double horizon);

}  // namespace carom
