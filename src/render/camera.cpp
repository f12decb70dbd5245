// The camera's frame, and the test whether a sphere is in view. The test uses the distance to the frustum. Tests of
// single planes would accept spheres beyond its edges.
#include "render/camera.h"

#include <numbers>

#include "scene/film_layout.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double degree = std::numbers::pi / 180;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0;
  return (p - (a + t * ab)).norm();
}

/// The distance from a point to a convex quadrilateral with its corners in order.
double distance_to_quad(const Vec3& p, span<const Vec3, 4> q) {
  const Vec3 n = (q[2] - q[0]).cross(q[3] - q[1]).normalized();
  bool inside = true;
  double nearest = infinity;
  for (size_t i = 0; i < 4; ++i) {
    const Vec3 &a = q[i], &b = q[(i + 1) % 4];
    if (n.dot((b - a).cross(p - a)) < 0) inside = false;
    nearest = min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? std::abs(n.dot(p - q[0])) : nearest;
}

}  // namespace

Size picture_size(const Output& output) {
  if (output.frames) return output.frames->size;
  if (output.video) return layout_of(*output.video).picture;
  return {};
}

CameraFrame view_of(const Camera& camera, Size size) {
  CameraFrame view;
  view.forward = (camera.target - camera.eye).normalized();
  // Eye and target are in one place.
  if (!(view.forward.norm() > 0.5)) view.forward = Vec3(0, 0, -1);

  Vec3 right = view.forward.cross(camera.up.normalized());
  // With `up` along the line of sight the roll is undetermined. Keep +x to the right if possible, as seen from +z.
  if (!(right.norm() > 1e-9)) right = view.forward.cross(Vec3(0, 0, view.forward.y() > 0 ? 1 : -1));
  if (!(right.norm() > 1e-9)) right = view.forward.cross(Vec3(0, 1, 0));
  view.right = right.normalized();
  view.up = view.right.cross(view.forward);

  const double aspect = double(size.width) / size.height;
  const double half = std::tan(camera.fov * degree / 2);
  const double across = camera.fov_horizontal ? half : half * aspect;
  view.fov_x = 2 * std::atan(across) / degree;
  view.fov_y = 2 * std::atan(across / aspect) / degree;
  return view;
}

Camera turned(const Camera& camera, double angle) {
  Camera turned = camera;
  const Vec3 axis = camera.up.normalized(), way = camera.eye - camera.target;
  const Vec3 along = axis.dot(way) * axis, level = way - along;
  const double radians = std::remainder(angle, 360) * degree;
  turned.eye = camera.target + along + std::cos(radians) * level + std::sin(radians) * axis.cross(level);
  return turned;
}

bool is_sphere_in_view(const Camera& camera, const CameraFrame& view, const Vec3& center, double radius) {
  // The frustum is symmetric, so that its upper right quarter represents all.
  const Vec3 offset = center - camera.eye;
  const double x = std::abs(view.right.dot(offset)), y = std::abs(view.up.dot(offset)), z = view.forward.dot(offset);
  const double tx = std::tan(view.fov_x * degree / 2), ty = std::tan(view.fov_y * degree / 2);
  const double beyond_right = (x - z * tx) / hypot(1, tx), beyond_top = (y - z * ty) / hypot(1, ty);
  const double beyond = max({beyond_right, beyond_top, camera.near - z, z - camera.far});

  if (beyond <= 0) return true;
  if (!(beyond <= radius)) return false;

  // The centre is outside of one face, and perhaps of two. The distance to the frustum itself decides.
  const Vec3 p(x, y, z);
  const auto corner = [&](double sx, double sy, double depth) { return Vec3(sx * depth * tx, sy * depth * ty, depth); };
  const double n = camera.near, f = camera.far;
  const array<Vec3, 4> right{corner(1, -1, n), corner(1, 1, n), corner(1, 1, f), corner(1, -1, f)};
  const array<Vec3, 4> top{corner(-1, 1, n), corner(1, 1, n), corner(1, 1, f), corner(-1, 1, f)};
  const array<Vec3, 4> front{corner(-1, -1, n), corner(1, -1, n), corner(1, 1, n), corner(-1, 1, n)};
  const array<Vec3, 4> back{corner(-1, -1, f), corner(1, -1, f), corner(1, 1, f), corner(-1, 1, f)};

  for (const auto& face : {right, top, front, back})
    if (distance_to_quad(p, face) <= radius) return true;
  return false;
}

}  // namespace carom
