// The motion is collected for two directions, because only its end shows its shape. A motion that is less than half as
// high as it is deep, such as one on a table, is seen from higher up. There bodies hide one another less.
#include "render/camera_fit.h"

#include "std.h"

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
      motion_(scene, {Frustum(lens_, size, slight_elevation), Frustum(lens_, size, flat_elevation)}) {}

void CameraFit::add(const State& state) {
  motion_.add(state);
}

Camera CameraFit::camera() const {
  MotionView::Content content = motion_.content(0);
  const double height = size_along(content.bodies, motion_.direction(0).up());

  // Content that is long to the front is seen from above.
  const bool is_flat = 2 * height < size_along(content.bodies, motion_.direction(0).front());
  const size_t direction = is_flat ? 1 : 0;
  if (is_flat) content = motion_.content(direction);
  const Frustum& frustum = motion_.direction(direction);
  const Frustum::Reach& reach = content.reach[direction];

  Camera camera = lens_;
  const Vec3 middle = content.bodies.middle();
  camera.eye = frustum.eye(reach);
  double distance = frustum.depth(reach, middle);

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
