// A cone of view holds another one of the same direction if it holds its eye. So the eyes are framed as points are, and
// so are the corners of the pictures at the targets.
#include "render/common_view.h"

#include <numbers>

#include "std.h"

namespace carom {
namespace {

/// Tangents of half the angles of view.
array<double, 2> tangents(const CameraFrame& view) {
  return {std::tan(view.fov_x * std::numbers::pi / 360), std::tan(view.fov_y * std::numbers::pi / 360)};
}

double depth_of_target(const Camera& camera) {
  return (camera.target - camera.eye).norm();
}

}  // namespace

Camera common_view(span<const Camera> cameras, Size size) {
  Camera common = cameras.front();
  const CameraFrame view = view_of(common, size);
  const array<double, 2> tangent = tangents(view);
  const array<Vec3, 2> across = {view.right, view.up};

  // By side: how far it must be from the axis at the depth 0, so that all points are inside.
  array<double, 4> sides;
  sides.fill(-infinity);
  double farthest = -infinity;
  const auto include = [&](const Vec3& p) {
    const double depth = view.forward.dot(p);
    for (size_t i = 0; i < 2; ++i) {
      sides[2 * i] = max(sides[2 * i], across[i].dot(p) - tangent[i] * depth);
      sides[2 * i + 1] = max(sides[2 * i + 1], -across[i].dot(p) - tangent[i] * depth);
    }
  };

  for (const Camera& camera : cameras) {
    const CameraFrame its = view_of(camera, size);
    const array<double, 2> half = tangents(its);
    const double depth = depth_of_target(camera);
    if (its.forward.dot(view.forward) > 1 - 1e-12) include(camera.eye);
    for (const double x : {-half[0], half[0]})
      for (const double y : {-half[1], half[1]})
        include(camera.eye + depth * (its.forward + x * its.right + y * its.up));
    farthest = max(farthest, view.forward.dot(camera.target));
  }

  // The nearest eye: the wider of the two ways decides its depth, and it is in the middle of both.
  double depth = infinity;
  Vec3 eye = Vec3::Zero();
  for (size_t i = 0; i < 2; ++i) {
    depth = min(depth, -(sides[2 * i] + sides[2 * i + 1]) / (2 * tangent[i]));
    eye += (sides[2 * i] - sides[2 * i + 1]) / 2 * across[i];
  }
  common.eye = eye + depth * view.forward;
  const double distance = max(farthest - depth, depth_of_target(cameras.front()));
  common.target = common.eye + distance * view.forward;
  common.near = distance / 1000;
  common.far = distance * 1000;
  return common;
}

}  // namespace carom
