#pragma once
// How any two things of a World lie to each other and when they meet: the one table of pairs of volumes. a is a body; b
// a body or a fixed thing, whose position is world.fixed_position(b). Two volumes that do not turn touch where a point,
// x_b - x_a, meets their Minkowski sum: sphere and box make a rounded box, two cylinders a cylinder, sphere and
// cylinder a cylinder with a rim rounded as a torus, box and cylinder a rounded prism, two boxes a box.
#include <cstdint>

#include "geometry/contact_time.h"
#include "numerics/vec3.h"
#include "physics/world.h"

namespace carom {

struct Touch {
  double gap;   // m, negative: overlap
  Vec3 normal;  // unit, from a to b, where they are nearest
  Vec3 point;   // m, on a's surface where they are nearest (in the middle of an area that is)
  // Of the Minkowski sum: which face, edge, corner or rim is nearest. 0 for two spheres and for planes; a WallFeature
  // for a sphere and a wall; else as round_prism.h, slab_sum.h or tilted_sum.h (walls at an angle) count them.
  std::uint8_t feature;
};

/// The gap is as exact as the positions where it is small (compensated sums). Where sharp volumes overlap, or touch but
/// for rounding at edges or corners only, the normal is that of the face over which they are farthest apart (x before y
/// before z). `feature`: look there, where two things meet; no_feature: where they are nearest.
Touch touch(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature = no_feature);

/// Second derivative of the gap (m/s^2) under the constant relative velocity w = v_b - v_a (m/s): what the curvature of
/// the nearest feature adds to normal . (a_b - a_a). Zero on flat features, |w x n|^2 / distance between spheres.
double bending(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, const Touch& touch,
               const Vec3& w);

/// Whether a pair meets at this feature in a plane for as long as it does, so that motion along it is straight.
bool is_flat(const World& world, Entity a, Entity b, std::uint8_t feature);

/// Whether a fixed thing lies wholly behind the plane that body a, at xa (m), touches on the far side of the unit
/// vector n: no farther along n than the body's own surface reaches against it, but for rounding. A body that slides in
/// that plane cannot strike it.
bool lies_behind(const World& world, Entity a, const Vec3& xa, Entity fixed, const Vec3& n);

/// An instant, and where two things touch then.
struct FeatureTime {
  double time;           // s, or never
  std::uint8_t feature;  // as in Touch
};

/// First t in [0, horizon] at which a and b touch and approach, from x_b - x_a = motion.d on. `left`: the feature at
/// which the pair has just bounced (its gap is zero by definition), or no_feature; it stands for
/// motion.just_separated.
FeatureTime time_of_impact(const World& world, Entity a, Entity b, const RelativeMotion& motion, std::uint8_t left,
                           double horizon);
FeatureTime time_of_impact_by_kind(const World& world, Entity a, Entity b, const RelativeMotion& motion,
                                   std::uint8_t left, double horizon);

// Balls among themselves, the common case, need no look at volumes.
inline FeatureTime time_of_impact(const World& world, Entity a, Entity b, const RelativeMotion& motion,
                                  std::uint8_t left, double horizon) {
  if (world.volume.empty() && world.is_body(b) && motion.just_separated == (left != no_feature))
    return {sphere_contact_time(motion, world.radius[a] + world.radius[b], horizon), 0};
  return time_of_impact_by_kind(world, a, b, motion, left, horizon);
}

/// First t in (0, horizon] at which a pair in lasting contact at this feature comes to the feature's rim, and the
/// feature beyond it; never, no_feature where it has no rim. The motion keeps to the feature.
FeatureTime leave_feature(const World& world, Entity a, Entity b, std::uint8_t feature, const RelativeMotion& motion,
                          double horizon);

}  // namespace carom
