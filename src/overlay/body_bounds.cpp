#include "overlay/body_bounds.h"

#include "std.h"

namespace carom {

optional<BodyBounds> bounds_of(const Moment& moment, Entity body) {
  const Vec3& x = moment.state.position[body];
  const Volume volume = volume_now(moment.world, moment.state, body);
  const Eye& eye = moment.eye;
  const Vec3 middle = eye.point(x);
  if (!(middle.z() > eye.camera.near && middle.z() < eye.camera.far)) return nullopt;

  BodyBounds bounds{infinity, infinity, -infinity, -infinity};
  const auto include = [&](const Vec3& p) {
    const double z = max(p.z(), eye.camera.near);
    const double right = eye.size.width / 2.0 + p.x() / (z * eye.pixel);
    const double down = eye.size.height / 2.0 - p.y() / (z * eye.pixel);
    bounds = {min(bounds.left, right), min(bounds.top, down), max(bounds.right, right), max(bounds.bottom, down)};
  };

  if (volume.shape == Shape::sphere) {
    const double r = volume.half.x();
    for (const Vec3& side : {Vec3(r, r, 0), Vec3(-r, -r, 0)}) include(middle + side);
  } else {
    for (int i = 0; i < 8; ++i) {
      const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
      include(eye.point(x + sign.cwiseProduct(volume.half)));
    }
  }
  return bounds;
}

}  // namespace carom
