// Two views are collected, because only the end of a motion shows its shape. A motion that is less than half as high as
// it is deep, such as one on a table, is seen from higher up. There bodies hide one another less.
#include "render/camera_fit.h"

namespace carom {
namespace {

constexpr double flat_elevation = 30;  // degrees

/// The size of a box along a unit vector (m).
double size_along(const Extent& box, const Vec3& n) {
  return n.cwiseAbs().dot(box.high - box.low);
}

}  // namespace

CameraFit::CameraFit(const Scene& scene, Size size)
    : lens_(scene.camera ? static_cast<const Camera&>(*scene.camera) : Camera{}),
      low_(scene, Frustum(lens_, size, slight_elevation)),
      high_(scene, Frustum(lens_, size, flat_elevation)) {}

void CameraFit::add(const State& state) {
  low_.add(state);
  high_.add(state);
}

Camera CameraFit::camera() const {
  MotionView::Content content = low_.content();
  const double height = size_along(content.bodies, low_.frustum().up());
  const bool is_flat = 2 * height < size_along(content.bodies, low_.frustum().front());
  if (is_flat) content = high_.content();
  const Frustum& frustum = (is_flat ? high_ : low_).frustum();

  Camera camera = lens_;
  const Vec3 middle = content.bodies.middle();
  camera.eye = frustum.eye(content.reach);
  double distance = frustum.depth(content.reach, middle);
  // All is in one point.
  if (!(distance > 0)) {
    distance = 1;
    camera.eye = middle - frustum.view().forward;
  }
  camera.target = camera.eye + distance * frustum.view().forward;
  camera.near = distance / 1000;
  camera.far = distance * 1000;
  return camera;
}

}  // namespace carom
