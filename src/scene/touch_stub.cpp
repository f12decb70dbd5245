// A coarse touch() for as long as physics has none: cylinders count as boxes.
#include <algorithm>

#include "physics/touch.h"

namespace carom {
__attribute__((weak)) Touch touch(const World& w, Entity a, const Vec3& xa, Entity b, const Vec3& xb) {
  const Volume va = w.volume_of(a);
  Touch t{0, Vec3::UnitX(), xa, 0};
  if (w.is_plane(b)) {
    t.gap = (xa - xb).dot(w.plane(b).normal) - va.support(w.plane(b).normal);
    return t;
  }
  if (w.is_wall(b)) {
    t.gap = std::abs((xa - xb).dot(w.wall(b).normal)) - va.support(w.wall(b).normal);
    return t;
  }
  const Volume vb = w.volume_of(b);
  const bool sa = va.shape == Shape::sphere, sb = vb.shape == Shape::sphere;
  Vec3 half = Vec3::Zero();
  double r = 0;
  if (sa)
    r += va.half.x();
  else
    half += va.half;
  if (sb)
    r += vb.half.x();
  else
    half += vb.half;
  const Vec3 q = (xb - xa).cwiseAbs() - half;
  const double inside = std::min(0.0, q.maxCoeff());
  t.gap = q.cwiseMax(0).norm() + inside - r;
  return t;
}
}  // namespace carom
