#pragma once
// The tightest volume around a cloud of points. It gives the size of a body that has a mesh.

#include "physics/volume.h"
#include "std.h"

namespace carom {

struct Fit {
  Volume volume;
  Vec3 center;
};

/// The smallest sphere, upright cylinder or box along the axes that holds every point, in the points' own units. It is
/// the exact minimum, enlarged by rounding only (a few parts in 1e16). The cylinder's radius is that of the smallest
/// circle around the points seen from above. Cost: a few passes over the points. Throws std::invalid_argument: no
/// points, a point that is not finite, a volume without thickness.
Fit tightest(Shape shape, span<const Vec3> points);

}  // namespace carom
