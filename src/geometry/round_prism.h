#pragma once
// The Minkowski sum of two volumes of which neither is tilted: a rectangle of half widths half.x, half.z, fattened by a
// disc in its plane, drawn out by half.y to both sides of it, and fattened by a ball. A rounded box is one without the
// disc, a cylinder one without the rectangle, the sum of box and cylinder one without the ball. Where the ball is
// missing the rims are sharp.
#include <cstdint>

#include "geometry/contact_time.h"
#include "geometry/separation.h"
#include "geometry/touch.h"

namespace carom {

/// Signs of the sides x, y, z on which a point of the prism's surface lies; 0: between them. A face has one sign, an
/// edge two, a corner three. Where the rectangle has no width one surface bends about both its sides: there it has the
/// sign 1 (so a cylinder's side has signs 1 in x and z).
struct PrismFeature {
  int x, y, z;
  std::uint8_t code() const { return static_cast<std::uint8_t>((x + 1) + 3 * (y + 1) + 9 * (z + 1)); }
  static PrismFeature of(std::uint8_t code) { return {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1}; }
  bool level() const { return x != 0 || z != 0; }  // there is a way out in the rectangle's plane
  bool bent() const { return x != 0 && z != 0; }   // and it turns about a corner
};

struct RoundPrism {
  Vec3 half;    // m; y: half the height
  double disc;  // m
  double ball;  // m

  Separation nearest(const Vec3& p) const;

  /// The same for one feature's surface, endlessly continued.
  Separation at(const Vec3& p, std::uint8_t feature) const;

  /// The gap at a feature's surface after a displacement, from a known one: exact for small displacements too.
  double displaced_gap(const Vec3& p, std::uint8_t feature, double gap, const Vec3& displacement) const;

  /// The gap at a round rim, the one surface that is neither flat nor met as spheres meet, at time t (s): evaluated
  /// in double-double. False: another feature.
  bool rim_gap(std::uint8_t feature, const RelativeMotion& motion, double t, double& gap) const;

  /// Second derivative of the gap (m/s^2) at constant velocity w, for what the surface's curvature does.
  double bending(const Vec3& p, std::uint8_t feature, const Vec3& w) const;

  /// m, the least one of the surface at a feature that is neither flat nor sharp.
  double curvature_radius(const Vec3&, std::uint8_t feature) const {
    return PrismFeature::of(feature).y == 0 ? disc + ball : ball;
  }

  bool flat(std::uint8_t feature) const;

  /// An edge or a corner without rounding: of several normals.
  bool sharp(std::uint8_t feature) const;

  /// The face of a sharp edge or corner over which p is farthest out; x before y before z.
  std::uint8_t foremost_face(const Vec3& p, std::uint8_t feature) const;

  /// Calls visit(face) for each face that a sharp edge or corner lies between.
  template <typename Visit>
  void for_each_face(std::uint8_t feature, Visit visit) const {
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
  Vec3 within(const Vec3& p, std::uint8_t feature) const;

  /// Whether a point meets the feature's surface as spheres meet; if so, their motion and the sum of their radii.
  bool as_spheres(std::uint8_t feature, const RelativeMotion& motion, RelativeMotion& reduced, double& radius) const;

  /// See leave_feature in touch.h. The motion's d is in the prism's frame.
  FeatureTime leave(std::uint8_t feature, const RelativeMotion& motion, double horizon) const;

  double size() const { return half.sum() + disc + ball; }

 private:
  bool round() const { return half.x() == 0 && half.z() == 0; }
  struct Excess {
    double u;    // m, beyond rectangle and disc in their plane
    Vec3 out;    // unit, in which direction
    double rho;  // m, distance from the rectangle's corner, where it is the centre
  };
  Excess excess(const Vec3& p, PrismFeature feature) const;
  PrismFeature unique(PrismFeature feature) const;
  Vec3 from_corner(const Vec3& p, PrismFeature feature) const;
  PrismFeature nearest_side(const Vec3& p) const;
  FeatureTime leave_round_cap(PrismFeature feature, const RelativeMotion& motion, double horizon) const;
};

}  // namespace carom
