#pragma once
// Distance of two things, computed without the program's own geometry (except boxes and cylinders at walls): in
// long double, straight from the definitions of the volumes.
#include "physics/world.h"

namespace carom::stress {

using Long3 = Eigen::Matrix<long double, 3, 1>;

/// The gap in m; negative: overlap. Outside it is the distance; inside, the shortest displacement that separates, along
/// the volumes' axes. xb: the position of a body, the point of a plane, or the centre of a wall or an obstacle.
long double gap(const World& world, Entity a, const Long3& xa, Entity b, const Long3& xb);

}  // namespace carom::stress
