#pragma once
// The Minkowski sum of two volumes along the axes. It starts as a rectangle of half widths half.x and half.z.
// The rectangle is enlarged by a disc in its plane, extended by half.y to both sides, and enlarged by a ball.
// A rounded box has no disc, a cylinder no rectangle, and the sum of box and cylinder no ball. Without the ball the
// rims are sharp.

#include "geometry/contact_time.h"
#include "geometry/separation.h"
#include "std.h"

namespace carom {

/// Signs of the sides x, y, z on which a point of the prism's surface lies; 0: between them.
/// A face has one sign, an edge two, a corner three.
/// Where the rectangle has no width, one surface bends about both its sides, and its sign is 1. A cylinder's side thus
/// has signs 1 in x and z.
struct PrismFeature {
  int x, y, z;
  uint8_t code() const { return uint8_t((x + 1) + 3 * (y + 1) + 9 * (z + 1)); }
  static PrismFeature of(uint8_t code) { return {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1}; }
  // The normal has a part in the rectangle's plane.
  bool level() const { return x != 0 || z != 0; }
  // That part turns about a corner.
  bool bent() const { return x != 0 && z != 0; }
};

struct RoundPrism {
  Vec3 half;    // m; y: half the height
  double disc;  // m
  double ball;  // m

  Separation nearest(const Vec3& p) const;

  /// The same for one feature's surface, extended without end.
  Separation at(const Vec3& p, uint8_t feature) const;

  /// The gap at a feature's surface after a displacement, from a known gap. It is exact for small displacements too.
  double displaced_gap(const Vec3& p, uint8_t feature, double gap, const Vec3& displacement) const;

  /// The gap at a round rim at time t (s), in double-double. False: the feature is not a round rim.
  /// That is the one surface that is neither flat nor met as spheres meet.
  bool rim_gap(uint8_t feature, const RelativeMotion& motion, double t, double& gap) const;

  /// Second derivative of the gap (m/s^2) at constant velocity w (m/s): the effect of the surface's curvature.
  double bending(const Vec3& p, uint8_t feature, const Vec3& w) const;

  /// The least radius of curvature at a feature that is neither flat nor sharp (m).
  double curvature_radius(const Vec3&, uint8_t feature) const {
    return PrismFeature::of(feature).y == 0 ? disc + ball : ball;
  }

  bool flat(uint8_t feature) const;

  /// Whether the feature is an edge or a corner without rounding, which has several normals.
  bool sharp(uint8_t feature) const;

  /// The face of a sharp edge or corner over which p is farthest out. Ties go to x before y before z.
  uint8_t foremost_face(const Vec3& p, uint8_t feature) const;

  /// Calls visit(face) for each face at a sharp edge or corner.
  void for_each_face(uint8_t feature, const auto& visit) const {
    const PrismFeature f = PrismFeature::of(feature);
    if (f.bent() && disc > 0) {
      visit(PrismFeature{f.x, 0, f.z}.code());
    } else {
      if (f.x != 0) visit(PrismFeature{f.x, 0, 0}.code());
      if (f.z != 0) visit(PrismFeature{0, 0, f.z}.code());
    }
    if (f.y != 0) visit(PrismFeature{0, f.y, 0}.code());
  }

  /// p, moved by no more than rounding into the region that is nearest to this feature.
  Vec3 within(const Vec3& p, uint8_t feature) const;

  /// Whether a point meets the feature's surface as spheres meet. If so, it gives their motion and the sum of their
  /// radii.
  bool as_spheres(uint8_t feature, const RelativeMotion& motion, RelativeMotion& reduced, double& radius) const;

  /// See leave_feature in touch.h. The motion's d is in the prism's frame.
  FeatureTime leave(uint8_t feature, const RelativeMotion& motion, double horizon) const;

  double size() const { return half.sum() + disc + ball; }

 private:
  bool round() const { return half.x() == 0 && half.z() == 0; }
  struct Excess {
    double u;    // m, beyond rectangle and disc, in their plane
    Vec3 out;    // unit, the direction of that
    double rho;  // m, distance from the rectangle's corner, if the surface bends about it
  };
  Excess excess(const Vec3& p, PrismFeature feature) const;
  PrismFeature unique(PrismFeature feature) const;
  Vec3 from_corner(const Vec3& p, PrismFeature feature) const;
  PrismFeature nearest_side(const Vec3& p) const;
  FeatureTime leave_round_cap(PrismFeature feature, const RelativeMotion& motion, double horizon) const;
};

}  // namespace carom
