// The Minkowski sum of a box and a wall at any angle, as an intersection of slabs. Each pair of its five segments spans
// the faces of one slab. There are at most ten slabs, so that all are tried.
#include "geometry/slab_sum.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

SlabSum::SlabSum(const Vec3& half, const Wall& wall) : size_(half.sum() + wall.half_width + wall.half_height) {
  const Vec3 along[5] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), wall.right, wall.up};
  const double reach[5] = {half.x(), half.y(), half.z(), wall.half_width, wall.half_height};

  for (int i = 0; i < 5; ++i)
    for (int j = i + 1; j < 5; ++j) {
      const Vec3 cross = along[i].cross(along[j]);
      const double sine = cross.norm();
      // Parallel: other pairs span their faces too.
      if (sine < 0x1p-50) continue;

      Slab& slab = slabs_[size_t(count_++)];
      slab = {i == 3 ? wall.normal : Vec3(cross / sine), 0};
      for (int k = 0; k < 5; ++k)
        if (k != i && k != j) slab.half += reach[k] * std::abs(along[k].dot(slab.normal));
    }
}

Separation SlabSum::nearest(const Vec3& p) const {
  int face = 0;
  double gap = -never;
  for (int k = 0; k < count_; ++k) {
    const Slab& slab = slabs_[size_t(k)];
    const double along = slab.normal.dot(p);
    if (std::abs(along) - slab.half > gap) {
      gap = std::abs(along) - slab.half;
      face = 2 * k + (along < 0);
    }
  }
  return at(p, uint8_t(face));
}

Separation SlabSum::at(const Vec3& p, uint8_t feature) const {
  const Slab& slab = slabs_[feature / 2];
  const Vec3 n = feature % 2 == 0 ? slab.normal : Vec3(-slab.normal);
  return {n.dot(p) - slab.half, n, feature};
}

double SlabSum::displaced_gap(const Vec3&, uint8_t feature, double gap, const Vec3& by) const {
  const double along = slabs_[feature / 2].normal.dot(by);
  return gap + (feature % 2 == 0 ? along : -along);
}

FeatureTime SlabSum::leave(uint8_t feature, const RelativeMotion& m, double horizon) const {
  FeatureTime first{never, no_feature};
  const Vec3& n = slabs_[feature / 2].normal;
  for (int k = 0; k < 2 * count_; ++k) {
    const auto other = uint8_t(k);
    if (other / 2 == feature / 2) continue;
    const Separation s = at(m.d, other);
    // The same face, spanned by another pair.
    if (s.normal.cross(n).squaredNorm() < 0x1p-80) continue;
    const double t = plane_contact_time(-s.gap, -s.normal.dot(m.w), -s.normal.dot(m.a), 0, false, horizon);
    if (t < first.time) first = {t, other};
  }
  return first;
}

}  // namespace carom
