#pragma once
// The Minkowski sum of an upright cylinder and a wall at any angle: a disc extended along three segments. The segments
// are the cylinder's axis and the wall's width and height. The surface has two caps and three pairs of flat faces,
// which two segments span. The round patches between them are the disc's rim extended along one segment. The projection
// along that segment into the disc's plane is a parallelogram with round corners. There a patch is an arc of a circle,
// at any angle.

#include "geometry/contact_time.h"
#include "geometry/separation.h"
#include "physics/volume.h"
#include "std.h"

namespace carom {

class TiltedSum : public BluntSum {
 public:
  // Features 0 to 5 are faces: 0, 1 spanned by axis and width, 2, 3 by axis and height, 4, 5 by width and height.
  // Features 6 and 7 are the caps. Even ones are along the normal. The patches along axis, width and height follow,
  // four corners each.
  static constexpr uint8_t caps = 6, patches = 8;

  TiltedSum(const Volume& cylinder, const Wall& wall);

  /// The gap along the best of the surface's normals. It is at most the distance.
  Separation nearest(const Vec3& p) const;
  Separation at(const Vec3& p, uint8_t feature) const;
  double displaced_gap(const Vec3& p, uint8_t feature, double gap, const Vec3& displacement) const;
  double bending(const Vec3& p, uint8_t feature, const Vec3& w) const;
  bool flat(uint8_t feature) const { return feature < patches; }
  bool as_spheres(uint8_t feature, const RelativeMotion& motion, RelativeMotion& reduced, double& radius) const;
  FeatureTime leave(uint8_t feature, const RelativeMotion& motion, double horizon) const;
  double curvature_radius(const Vec3& p, uint8_t feature) const;
  double size() const { return size_; }

 private:
  struct Patch {
    int along;    // number of the segment
    Vec3 center;  // m, of the arc: the sum of the other two segments, with the corner's signs
  };
  Patch patch(uint8_t feature) const;
  Vec3 shadow(const Vec3& p, int along) const;
  Vec3 slanted(const Vec3& level, int along) const;
  double support(const Vec3& n) const;
  uint8_t nearest_corner(const Vec3& p, int along) const;
  Vec3 face_normal(uint8_t feature) const;
  Separation nearest_but(const Vec3& p, int without) const;

  double radius_;                // m
  array<Vec3, 3> segments_;      // m, halves
  array<bool, 3> casts_;         // whether the segment leaves the disc's plane
  array<Vec3, 3> face_normals_;  // unit; zero where two segments are parallel
  double size_;                  // m
};

}  // namespace carom
