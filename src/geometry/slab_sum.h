#pragma once
// The Minkowski sum of a box and a wall at any angle: a polytope drawn out along five segments. It is where all slabs
// meet that two of its segments span, at most ten.
#include <array>

#include "geometry/contact_time.h"
#include "geometry/separation.h"
#include "geometry/touch.h"

namespace carom {

/// A face's feature is 2 k for slab k's face along its normal and 2 k + 1 for the one opposite.
class SlabSum {
 public:
  /// half: the box's half edges (m).
  SlabSum(const Vec3& half, const Wall& wall);

  /// The face that p is farthest beyond, or least behind: its gap is at most the distance.
  Separation nearest(const Vec3& p) const;
  Separation at(const Vec3& p, std::uint8_t feature) const;
  double displaced_gap(const Vec3& p, std::uint8_t feature, double gap, const Vec3& displacement) const;
  FeatureTime leave(std::uint8_t feature, const RelativeMotion& motion, double horizon) const;
  double size() const { return size_; }

  // All of the surface is faces.
  bool flat(std::uint8_t) const { return true; }
  double curvature_radius(const Vec3&, std::uint8_t) const { return size_; }
  bool sharp(std::uint8_t) const { return false; }
  double bending(const Vec3&, std::uint8_t, const Vec3&) const { return 0; }
  Vec3 within(const Vec3& p, std::uint8_t) const { return p; }
  bool as_spheres(std::uint8_t, const RelativeMotion&, RelativeMotion&, double&) const { return false; }
  std::uint8_t foremost_face(const Vec3&, std::uint8_t feature) const { return feature; }
  bool rim_gap(std::uint8_t, const RelativeMotion&, double, double&) const { return false; }
  template <typename Visit>
  void for_each_face(std::uint8_t, Visit) const {}

 private:
  struct Slab {
    Vec3 normal;  // unit
    double half;  // m
  };
  std::array<Slab, 10> slabs_;
  int count_ = 0;
  double size_;  // m
};

}  // namespace carom
