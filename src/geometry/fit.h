#pragma once
// The tightest volume around a cloud of points: how large a body is that is given by a mesh.
#include <span>

#include "physics/volume.h"

namespace carom {

struct Fit {
  Volume volume;
  Vec3 center;
};

/// The smallest sphere, or upright cylinder, or box along the axes that holds every point: the exact minimum, enlarged
/// by rounding only (a few parts in 1e16). The sphere is the smallest of all; the cylinder's radius is that of the
/// smallest circle around the points seen from above. In the points' own units. Takes a few passes over the points.
/// Throws std::invalid_argument: no points, a point that is not finite, a volume without thickness.
Fit tightest(Shape shape, std::span<const Vec3> points);

}  // namespace carom
