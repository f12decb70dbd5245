#pragma once
// The relative position of any two things of a World, and their times of impact: the one table of pairs of volumes.
// The first, a, is a body. The second, b, is a body or a fixed thing with the position that is given.
// Two volumes that do not turn touch where the point x_b - x_a meets their Minkowski sum:
// - sphere and box: a rounded box
// - two cylinders: a cylinder
// - sphere and cylinder: a cylinder with a rim rounded as a torus
// - box and cylinder: a rounded prism
// - two boxes: a box
// A shell (shell.h) meets balls alone.
// A string is the inside of a sphere about its other end. Its position is that of the other end: of a body, or the
// anchor. Its gap is its length less the distance, and its normal points from the other end to the body.

#include "geometry/contact_time.h"
#include "numerics/vec3.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

struct Touch {
  double gap;  // m, negative: overlap
  // Unit, from a to b, at the closest points.
  Vec3 normal;
  // m, the closest point on a's surface, or the middle of an area of them.
  Vec3 point;
  // The nearest face, edge, corner or rim of the Minkowski sum. It is 0 for two spheres, planes and strings, a
  // WallFeature for a sphere and a wall, and a ShellFeature for a sphere and a shell. Other pairs number features as in
  // round_prism.h, slab_sum.h or tilted_sum.h (walls at an angle).
  uint8_t feature;
};

/// Where the gap is small it is as exact as the positions (compensated sums). Sharp volumes may overlap, or touch up to
/// rounding at edges or corners only. The normal is then that of the face over which they are farthest apart (x before
/// y before z). `feature`: the feature to use; no_feature: the nearest.
Touch touch(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, uint8_t feature = no_feature);

/// Second derivative of the gap (m/s^2) under the constant relative velocity w = v_b - v_a (m/s).
/// It is what the curvature of the nearest feature adds to normal . (a_b - a_a): zero on flat features, |w x n|^2 /
/// distance between spheres, and the negative of that for a string.
double bending(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, const Touch& touch,
               const Vec3& w);

/// Whether contact of a pair at this feature lies in a plane as long as it lasts, so that motion along it is straight.
bool is_flat(const World& world, Entity a, Entity b, uint8_t feature);

/// Whether a fixed thing at xf (m) lies wholly behind the plane in which body a, at xa (m), touches on the side against
/// the unit vector n. It then extends no farther along n than the body's own surface does against it, up to rounding. A
/// body that slides in that plane cannot strike it.
bool lies_behind(const World& world, Entity a, const Vec3& xa, Entity fixed, const Vec3& xf, const Vec3& n);

/// First t in [0, horizon] at which a and b touch and approach, from x_b - x_a = motion.d on.
/// `left`: the feature at which the pair has just bounced (its gap is zero by definition), or no_feature. It replaces
/// motion.just_separated.
FeatureTime time_of_impact(const World& world, Entity a, Entity b, const RelativeMotion& motion, uint8_t left,
                           double horizon);
FeatureTime time_of_impact_by_kind(const World& world, Entity a, Entity b, const RelativeMotion& motion, uint8_t left,
                                   double horizon);

// Pairs of balls, the common case, need no test of volumes.
inline FeatureTime time_of_impact(const World& world, Entity a, Entity b, const RelativeMotion& motion, uint8_t left,
                                  double horizon) {
  if (world.volume.empty() && world.is_body(b) && motion.just_separated == (left != no_feature))
    return {sphere_contact_time(motion, world.radius[a] + world.radius[b], horizon), 0};
  return time_of_impact_by_kind(world, a, b, motion, left, horizon);
}

/// First t in (0, horizon] at which a pair in lasting contact at this feature arrives at the feature's rim, and the
/// feature beyond it. It is never, no_feature where there is no rim. The motion must keep to the feature.
FeatureTime leave_feature(const World& world, Entity a, Entity b, uint8_t feature, const RelativeMotion& motion,
                          double horizon);

}  // namespace carom
