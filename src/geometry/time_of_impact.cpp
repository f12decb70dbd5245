// Times of impact on parabolas, by the kind of pair. Spheres, planes and walls have closed forms.
// All other pairs take conservative advancement on their Minkowski sum, which finishes with the closed form of the
// feature, where there is one.
#include "geometry/conservative_advancement.h"
#include "geometry/pair.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// The size of the positions of which motion.d, from a to b, is the difference, as far as it is known.
double size_of_positions(const World& world, Entity b, const RelativeMotion& motion) {
  if (world.is_body(b)) return motion.d.cwiseAbs().sum();
  const Vec3& x = world.fixed_position(b);
  return x.cwiseAbs().sum() + (x - motion.d).cwiseAbs().sum() + 2 * motion.moved;
}

FeatureTime meet_spheres(const RelativeMotion& motion, double s, uint8_t left, double horizon) {
  RelativeMotion m = motion;
  m.just_separated = left != no_feature;
  return {sphere_contact_time(m, s, horizon), 0};
}

/// d points to the plane's point.
FeatureTime meet_plane(const Plane& plane, const RelativeMotion& m, double reach, uint8_t left, double horizon) {
  const double noise = 0x1p-49 * m.speeds;
  const double gap = plane_gap(-m.d, Vec3::Zero(), plane.normal, reach);
  return {plane_contact_time(gap, -plane.normal.dot(m.w), -plane.normal.dot(m.a), noise, left != no_feature, horizon),
          0};
}

}  // namespace

FeatureTime time_of_impact_by_kind(const World& world, Entity a, Entity b, const RelativeMotion& motion, uint8_t left,
                                   double horizon) {
  switch (pair_kind(world, a, b)) {
    case PairKind::spheres: {
      const double s = world.volume_of(a).half.x() + world.volume_of(b).half.x();
      return meet_spheres(motion, s, left, horizon);
    }
    case PairKind::half_space:
      return meet_plane(world.plane(b), motion, world.volume_of(a).support(world.plane(b).normal), left, horizon);
    case PairKind::sphere_wall: {
      const WallContact c = wall_contact_time(world.wall(b), motion, world.volume_of(a).half.x(), left, horizon);
      return {c.time, c.feature};
    }
    case PairKind::prism: {
      const PairPrism pair = pair_prism(world, a, b);
      return ConservativeAdvancement(pair.sum, in_frame(pair.frame, motion), size_of_positions(world, b, motion),
                                     horizon)
          .run(left);
    }
    case PairKind::box_wall: {
      const SlabSum sum = slab_sum(world, a, b);
      return ConservativeAdvancement(sum, motion, size_of_positions(world, b, motion), horizon).run(left);
    }
    case PairKind::cylinder_wall: {
      const TiltedSum sum = tilted_sum(world, a, b);
      return ConservativeAdvancement(sum, motion, size_of_positions(world, b, motion), horizon).run(left);
    }
    case PairKind::string: {
      RelativeMotion m = motion;
      m.just_separated = left != no_feature;
      return {taut_time(m, world.string(b).length, horizon), 0};
    }
  }
  return {never, no_feature};
}

FeatureTime leave_feature(const World& world, Entity a, Entity b, uint8_t feature, const RelativeMotion& motion,
                          double horizon) {
  switch (pair_kind(world, a, b)) {
    case PairKind::spheres:
    case PairKind::half_space:
    case PairKind::string:
      return {never, no_feature};
    case PairKind::sphere_wall: {
      if (feature < wall_edges) {
        const WallContact c = wall_release_time(world.wall(b), motion, horizon);
        return {c.time, c.feature};
      }
      const PairPrism pair = pair_prism(world, a, b);
      const RelativeMotion m = in_frame(pair.frame, motion);
      const FeatureTime beyond = pair.sum.leave(prism_feature(feature, m.d), m, horizon);
      return {beyond.time, beyond.feature == no_feature ? no_feature : wall_feature(beyond.feature)};
    }
    case PairKind::prism: {
      const PairPrism pair = pair_prism(world, a, b);
      return pair.sum.leave(feature, in_frame(pair.frame, motion), horizon);
    }
    case PairKind::box_wall:
      return slab_sum(world, a, b).leave(feature, motion, horizon);
    case PairKind::cylinder_wall:
      return tilted_sum(world, a, b).leave(feature, motion, horizon);
  }
  return {never, no_feature};
}

}  // namespace carom
