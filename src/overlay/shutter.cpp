// A step of a pixel is as wide as the smoothed edge of a body, so that the steps of a blurred edge join without a
// plateau. The exposure ends at the picture's time: what a picture shows has happened by the time in its caption.
#include "overlay/shutter.h"

#include "physics/body_now.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A point in pixels from the middle of the picture, and its distance along the line of sight (m).
struct Projected {
  double x, y, z;
};

Projected projected(const Eye& eye, const Vec3& x) {
  const Vec3 p = eye.point(x);
  return {p.x() / (p.z() * eye.pixel), p.y() / (p.z() * eye.pixel), p.z()};
}

/// Whether a disc that moves from `a` to `b` touches the picture on this axis.
bool meets(double a, double b, double radius, double half) {
  return min(a, b) - radius <= half && max(a, b) + radius >= -half;
}

}  // namespace

int exposures_of(const Scene& scene, const State& state, double open, const Eye& opening, const Eye& closing) {
  double most = 1;
  for (size_t i = 0; i < state.position.size(); ++i) {
    if (is_gone(state, Entity(i))) continue;
    const Vec3 &x = state.position[i], &v = state.velocity[i];
    const Projected from = projected(opening, x), to = projected(closing, x + open * v);
    const double nearest = min(from.z, to.z);
    if (!(nearest > opening.camera.near)) continue;
    const double radius = radius_now(scene.world, state, Entity(i)) / (nearest * opening.pixel);
    if (meets(from.x, to.x, radius, 0.5 * opening.size.width) && meets(from.y, to.y, radius, 0.5 * opening.size.height))
      most = max(most, hypot(to.x - from.x, to.y - from.y));
  }
  return int(min(ceil(most), double(most_exposures)));
}

void Shutter::aim(double picture, double pace) {
  if (picture == picture_) return;
  from_ = max(picture_, picture - pace * open_);
  picture_ = picture;
  opened_ = !(from_ < picture);
  count_ = done_ = 0;
}

void Shutter::open_for(int count) {
  opened_ = true;
  count_ = count;
  done_ = 0;
}

double Shutter::next() const {
  if (!opened_) return from_;
  if (done_ + 1 >= count_) return infinity;
  // From the right, so that the picture's own time is one of the instants.
  return picture_ - (picture_ - from_) * (count_ - 1 - done_) / count_;
}

}  // namespace carom
