// The scene's camera, or a default one, and the test whether a sphere is in view. The default camera looks at the box
// of all bodies and of the fixed things near them, as near as all its corners allow. The test uses the distance to the
// frustum. Tests of single planes would accept spheres beyond its edges.
#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// An axis-aligned box that grows.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  bool empty() const { return !(min.x() <= max.x()); }
  double diagonal() const { return (max - min).norm(); }
};

bool drawn(const Scene& scene, std::size_t fixed) {
  return fixed >= scene.roster.fixed.size() || scene.roster.fixed[fixed].visible;
}

/// The box of the bodies, of the surfaces that they may fall or fly onto, and of the walls and obstacles among them.
Box box_of(const Scene& scene) {
  Box bodies;
  for (std::size_t i = 0; i < scene.world.radius.size() && i < scene.initial.position.size(); ++i) {
    const Vec3 half =
        scene.world.volume.empty() ? Vec3(Vec3::Constant(scene.world.radius[i])) : scene.world.volume[i].half;
    bodies.add(scene.initial.position[i] - half);
    bodies.add(scene.initial.position[i] + half);
  }
  if (bodies.empty()) {
    for (const Plane& plane : scene.world.planes) bodies.add(plane.point);
    for (const Wall& wall : scene.world.walls) bodies.add(wall.center);
    for (const Obstacle& obstacle : scene.world.obstacles) {
      bodies.add(obstacle.center - obstacle.volume.half);
      bodies.add(obstacle.center + obstacle.volume.half);
    }
  }
  if (bodies.empty()) bodies.add(Vec3::Zero());
  const double size = std::max(bodies.diagonal(), 1e-9);
  const Vec3 middle = (bodies.min + bodies.max) / 2;

  Box all = bodies;
  for (std::size_t i = 0; i < scene.world.planes.size(); ++i) {
    if (!drawn(scene, i)) continue;
    const Plane& plane = scene.world.planes[i];
    const double height = plane.normal.dot(middle - plane.point);
    // Bodies may fall onto a plane below from any height. A plane beside them counts only if it is near.
    const bool below = scene.world.gravity.dot(plane.normal) < -0.5 * scene.world.gravity.norm();
    if (height > 0 && height < (below ? 100 : 3) * size) all.add(middle - height * plane.normal);
  }
  for (std::size_t i = 0; i < scene.world.walls.size(); ++i) {
    const Wall& wall = scene.world.walls[i];
    if (!drawn(scene, scene.world.planes.size() + i) || (wall.center - middle).norm() > 3 * size) continue;
    for (double u : {-1.0, 1.0})
      for (double v : {-1.0, 1.0})
        all.add(wall.center + u * wall.half_width * wall.right + v * wall.half_height * wall.up);
  }
  const std::size_t obstacles = scene.world.planes.size() + scene.world.walls.size();
  for (std::size_t i = 0; i < scene.world.obstacles.size(); ++i) {
    if (!drawn(scene, obstacles + i)) continue;
    // Only the near part counts: a floor may be a box of any size.
    const Obstacle& obstacle = scene.world.obstacles[i];
    const Vec3 near_low = bodies.min.array() - size, near_high = bodies.max.array() + size;
    const Vec3 low = (obstacle.center - obstacle.volume.half).cwiseMax(near_low);
    const Vec3 high = (obstacle.center + obstacle.volume.half).cwiseMin(near_high);
    if ((low.array() > high.array()).any()) continue;
    all.add(low);
    all.add(high);
  }
  return all;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0;
  return (p - (a + t * ab)).norm();
}

/// The distance from a point to a convex quadrilateral with its corners in order.
double distance_to_quad(const Vec3& p, std::span<const Vec3, 4> q) {
  const Vec3 n = (q[2] - q[0]).cross(q[3] - q[1]).normalized();
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = q[i], &b = q[(i + 1) % 4];
    if (n.dot((b - a).cross(p - a)) < 0) inside = false;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? std::abs(n.dot(p - q[0])) : nearest;
}

}  // namespace

Size picture_size(const Output& output) {
  if (output.frames) return output.frames->size;
  if (output.video) return output.video->size;
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

  const double aspect = static_cast<double>(size.width) / size.height;
  const double half = std::tan(camera.fov * degree / 2);
  const double across = camera.fov_horizontal ? half : half * aspect;
  view.fov_x = 2 * std::atan(across) / degree;
  view.fov_y = 2 * std::atan(across / aspect) / degree;
  return view;
}

bool is_sphere_in_view(const Camera& camera, const CameraFrame& view, const Vec3& center, double radius) {
  // The frustum is symmetric, so that its upper right quarter represents all.
  const Vec3 offset = center - camera.eye;
  const double x = std::abs(view.right.dot(offset)), y = std::abs(view.up.dot(offset)), z = view.forward.dot(offset);
  const double tx = std::tan(view.fov_x * degree / 2), ty = std::tan(view.fov_y * degree / 2);
  const double beyond_right = (x - z * tx) / std::hypot(1, tx), beyond_top = (y - z * ty) / std::hypot(1, ty);
  const double beyond = std::max({beyond_right, beyond_top, camera.near - z, z - camera.far});
  if (beyond <= 0) return true;
  if (!(beyond <= radius)) return false;

  // The centre is outside of one face, and perhaps of two. The distance to the frustum itself decides.
  const Vec3 p(x, y, z);
  const auto corner = [&](double sx, double sy, double depth) { return Vec3(sx * depth * tx, sy * depth * ty, depth); };
  const double n = camera.near, f = camera.far;
  const std::array<Vec3, 4> right{corner(1, -1, n), corner(1, 1, n), corner(1, 1, f), corner(1, -1, f)};
  const std::array<Vec3, 4> top{corner(-1, 1, n), corner(1, 1, n), corner(1, 1, f), corner(-1, 1, f)};
  const std::array<Vec3, 4> front{corner(-1, -1, n), corner(1, -1, n), corner(1, 1, n), corner(-1, 1, n)};
  const std::array<Vec3, 4> back{corner(-1, -1, f), corner(1, -1, f), corner(1, 1, f), corner(-1, 1, f)};
  for (const auto& face : {right, top, front, back})
    if (distance_to_quad(p, face) <= radius) return true;
  return false;
}

Camera camera_of(const Scene& scene) {
  if (scene.camera) return *scene.camera;
  Camera camera;
  const Box box = box_of(scene);
  camera.target = (box.min + box.max) / 2;
  // From the front, slightly downwards.
  const Vec3 back = Vec3(0, std::sin(18 * degree), std::cos(18 * degree));
  camera.eye = camera.target + back;
  const CameraFrame view = view_of(camera, picture_size(scene.output));
  const double margin = 1.12;
  const double tx = std::tan(view.fov_x * degree / 2) / margin, ty = std::tan(view.fov_y * degree / 2) / margin;

  // As near as all eight corners allow: |x| <= (distance + z) tx, z along the line of sight from the centre.
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                      i & 4 ? box.max.z() : box.min.z());
    const Vec3 p = corner - camera.target;
    const double z = view.forward.dot(p);
    distance = std::max({distance, std::abs(view.right.dot(p)) / tx - z, std::abs(view.up.dot(p)) / ty - z});
  }
  if (!(distance > 0)) distance = 1;
  camera.eye = camera.target + distance * back;
  camera.near = distance / 1000;
  camera.far = distance * 1000;
  return camera;
}

}  // namespace carom
