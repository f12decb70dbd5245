// A convex thing is inside a side with inward normal n if n . (x - eye) >= 0 for all its points x. Of any number of
// things only the least n . x counts, so that a motion of any length leaves four numbers. The eye is then the solution
// of four linear inequalities. Boxes around things would be looser in perspective.
#include "render/frustum.h"

#include <numbers>

#include "std.h"

namespace carom {
namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The front is the side of +z. With z up or down it is that of +y, above.
Vec3 front_of(const Vec3& up, double azimuth) {
  const Vec3 level = Vec3(0, 0, 1) - up.z() * up;
  const Vec3 front = level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(0, 1, 0);
  if (azimuth == 0) return front;
  return std::cos(radians(azimuth)) * front + std::sin(radians(azimuth)) * up.cross(front);
}

CameraFrame frame_of(Camera lens, Size size, const Vec3& front, double elevation) {
  lens.eye = std::cos(radians(elevation)) * front + std::sin(radians(elevation)) * lens.up.normalized();
  lens.target = Vec3::Zero();
  return view_of(lens, size);
}

}  // namespace

Frustum::Frustum(const Camera& lens, Size size, double elevation, double azimuth)
    : up_(lens.up.normalized()),
      front_(front_of(up_, azimuth)),
      view_(frame_of(lens, size, front_, elevation)),
      tan_x_(used * std::tan(radians(view_.fov_x / 2))),
      tan_y_(used * std::tan(radians(view_.fov_y / 2))),
      normals_{(tan_x_ * view_.forward + view_.right).normalized(), (tan_x_ * view_.forward - view_.right).normalized(),
               (tan_y_ * view_.forward + view_.up).normalized(), (tan_y_ * view_.forward - view_.up).normalized()} {}

void Frustum::Reach::add(const Reach& other) {
  for (size_t i = 0; i < least.size(); ++i) least[i] = min(least[i], other.least[i]);
}

void Frustum::add(Reach& reach, const Vec3& center, double radius) const {
  for (size_t i = 0; i < normals_.size(); ++i) reach.least[i] = min(reach.least[i], normals_[i].dot(center) - radius);
}

void Frustum::add(Reach& reach, const Vec3& center, const Volume& volume) const {
  if (volume.shape == Shape::sphere) return add(reach, center, volume.half.x());
  for (size_t i = 0; i < normals_.size(); ++i)
    reach.least[i] = min(reach.least[i], normals_[i].dot(center) - volume.support(normals_[i]));
}

Vec3 Frustum::eye(const Reach& reach) const {
  // With the eye at (x, y, z) to the right, up and ahead: tan z + x <= left and tan z - x <= right, and so for bottom
  // and top.
  const double wide = hypot(1, tan_x_), high = hypot(1, tan_y_);
  const double left = wide * reach.least[0], right = wide * reach.least[1];
  const double bottom = high * reach.least[2], top = high * reach.least[3];
  const double z = min((left + right) / (2 * tan_x_), (bottom + top) / (2 * tan_y_));
  return (left - right) / 2 * view_.right + (bottom - top) / 2 * view_.up + z * view_.forward;
}

double Frustum::distance(const Reach& reach, const Vec3& target) const {
  double distance = 0;
  for (size_t i = 0; i < normals_.size(); ++i)
    distance = max(distance, (normals_[i].dot(target) - reach.least[i]) / normals_[i].dot(view_.forward));
  return distance;
}

}  // namespace carom
