// Times of impact on parabolas, by the kind of pair. Spheres, planes and walls have closed forms.
// All other pairs take conservative advancement on their Minkowski sum, which finishes with the closed form of the
// feature, where there is one.
#include "geometry/conservative_advancement.h"
#include "geometry/pair.h"
#include "geometry/shell.h"
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
  const PairKind kind = pair_kind(world, a, b);
  switch (kind) {
    case PairKind::spheres: {
      const double s = world.volume_of(a).half.x() + world.volume_of(b).half.x();
      return meet_spheres(motion, s, left, horizon);
    }
    case PairKind::half_space:
      return meet_plane(world.plane(b), motion, world.volume_of(a).support(world.plane(b).normal), left, horizon);

    case PairKind::sphere_wall:
      return wall_contact_time(world.wall(b), motion, world.volume_of(a).half.x(), left, horizon);
    case PairKind::shell:
      return Shell(world.obstacle(b)).contact_time(world.volume_of(a).half.x(), motion, left, horizon);
    case PairKind::string: {
      RelativeMotion m = motion;
      m.just_separated = left != no_feature;
      return {taut_time(m, world.string(b).length, horizon), 0};
    }

    default:
      return with_sum(kind, world, a, b, [&](const auto& sum, const Frame& frame) {
        const double far = size_of_positions(world, b, motion);
        return ConservativeAdvancement(sum, in_frame(frame, motion), far, horizon).run(left);
      });
  }
}

FeatureTime leave_feature(const World& world, Entity a, Entity b, uint8_t feature, const RelativeMotion& motion,
                          double horizon) {
  const PairKind kind = pair_kind(world, a, b);
  if (kind == PairKind::spheres || kind == PairKind::half_space || kind == PairKind::string) return {never, no_feature};
  if (kind == PairKind::shell) return Shell(world.obstacle(b)).leave(feature, motion, horizon);
  const bool of_wall = kind == PairKind::sphere_wall;
  if (of_wall && feature < wall_edges) return wall_release_time(world.wall(b), motion, horizon);

  return with_sum(kind, world, a, b, [&](const auto& sum, const Frame& frame) {
    const RelativeMotion m = in_frame(frame, motion);
    FeatureTime beyond = sum.leave(of_wall ? prism_feature(feature, m.d) : feature, m, horizon);
    if (of_wall && beyond.feature != no_feature) beyond.feature = wall_feature(beyond.feature);
    return beyond;
  });
}

}  // namespace carom
