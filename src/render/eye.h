#pragma once
// The camera's frame in the render passes: x to the right, y up, z ahead, the eye at the origin. A ray through a
// picture point is (x, y, 1). World coordinates are converted to this frame in double precision. Floats are used only
// after that.
#include <numbers>

#include "raster/shot.h"
#include "render/camera.h"
#include "std.h"

namespace carom {

inline raster::Float3 floats(const Vec3& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

struct Eye {
  Eye(const Camera& c, Size s) : camera(c), view(view_of(c, s)), size(s) {
    tan_x = std::tan(view.fov_x * std::numbers::pi / 360);
    tan_y = std::tan(view.fov_y * std::numbers::pi / 360);
    pixel = 2 * tan_x / s.width;
    per_cos_x = sqrt(1 + tan_x * tan_x), per_cos_y = sqrt(1 + tan_y * tan_y);
  }
  Vec3 direction(const Vec3& world) const {
    return Vec3(view.right.dot(world), view.up.dot(world), view.forward.dot(world));
  }
  Vec3 point(const Vec3& world) const { return direction(world - camera.eye); }

  /// Whether a ball at a place in the camera's frame may be in the picture. True for some beside its corners.
  bool may_see(const Vec3& p, double radius) const {
    const double z = p.z();
    return z + radius > camera.near && z - radius < camera.far && std::abs(p.x()) - z * tan_x < radius * per_cos_x &&
           std::abs(p.y()) - z * tan_y < radius * per_cos_y;
  }

  Camera camera;
  CameraFrame view;
  Size size;
  double tan_x, tan_y;          // of half the angles of view
  double per_cos_x, per_cos_y;  // one over the cosines of these
  double pixel;                 // a pixel's side in the plane z = 1
};

}  // namespace carom
