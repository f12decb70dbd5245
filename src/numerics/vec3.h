#pragma once
// The one vector type. Eigen is built without its own vectorisation (EIGEN_DONT_VECTORIZE). Sums then have one order,
// and a result has the same bits in every build.
#include <Eigen/Core>
#include <Eigen/Geometry>  // the cross product

namespace carom {

using Vec3 = Eigen::Vector3d;

}  // namespace carom
