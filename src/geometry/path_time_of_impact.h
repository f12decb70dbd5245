#pragma once
// When two things meet on paths that are no parabolas.
#include "geometry/touch.h"
#include "numerics/polynomial_path.h"
#include "physics/fading_path.h"

namespace carom {

/// First t in [0, horizon] at which a and b touch and approach, on paths that linear drag bends; pa and pb from the
/// same instant on (b fixed: a path that stands at its position). `left`: as in touch.h. speeds: m/s, what velocities
/// are rounded by. They are followed from separating plane to separating plane: until the path comes to the plane
/// through the closest points there is no contact, so that none is jumped over.
FeatureTime time_of_impact(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                           double speeds, std::uint8_t left, double horizon);

/// The same of things at xa and xb (m) on polynomial paths; displacement: m, of b less that of a, by t / length (s).
FeatureTime time_of_impact(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb,
                           const PolynomialPath::Terms& displacement, double length, double speeds, std::uint8_t left,
                           double horizon);

/// When a pair in lasting contact at this feature comes to its rim (touch.h), on such paths.
FeatureTime leave_feature(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                          std::uint8_t feature, double horizon);

}  // namespace carom
