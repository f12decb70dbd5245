// A region without its boundary.
#include "physics/world_region.h"

#include "std.h"

namespace carom {

bool holds(const WorldRegion& region, const Vec3& x) {
  const Vec3 d = x - region.position, &half = region.volume.half;
  if (region.is_side()) return d.dot(region.normal) > 0;
  if (!(d.cwiseAbs().array() < half.array()).all()) return false;
  switch (region.volume.shape) {
    case Shape::sphere:
      return d.squaredNorm() < half.x() * half.x();
    case Shape::cylinder:
      return d.x() * d.x() + d.z() * d.z() < half.x() * half.x();
    case Shape::box:
      return true;
  }
  return false;
}

}  // namespace carom
