// Times of impact on paths that are not parabolas, by conservative advancement from separating plane to separating
// plane. Until a path arrives at the plane through the closest points there is no contact. Sampling in time could miss
// a contact, this cannot.
#include "geometry/path_time_of_impact.h"

#include "geometry/conservative_advancement.h"
#include "geometry/pair.h"
#include "geometry/relative_way.h"
#include "geometry/shell.h"
#include "numerics/cube_root.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// The time of impact of volumes that are round or flat where they meet. speeds: scale of the velocities' rounding
/// (m/s).
template <typename Way>
FeatureTime meet_round(const Way& way, const World& world, Entity a, const Vec3& from_a, Entity b, const Vec3& xb,
                       double speeds, uint8_t left, double horizon) {
  const double far = from_a.cwiseAbs().sum() + xb.cwiseAbs().sum() + world.radius[a];
  const double closed = 0x1p-49 * far, noise = 0x1p-48 * speeds;

  double t = 0;
  for (int step_count = 0; step_count < 500 && t <= horizon; ++step_count) {
    // b does not move.
    const Vec3 xa = from_a - way.displacement(t);
    const bool leaving = t == 0 && left != no_feature;
    const Touch there = touch(world, a, xa, b, xb, leaving ? left : no_feature);

    const Vec3 w = way.velocity(t);
    const Vec3& n = there.normal;
    double gap = there.gap, rate = n.dot(w);

    // s: the path is surely outside for this long.
    double least = 0;
    if (!(gap > closed) || leaving) {
      const Vec3 bend = way.acceleration(t);
      const double acceleration = n.dot(bend), unsure = 0x1p-48 * bend.cwiseAbs().sum();
      if (std::abs(rate) <= noise) rate = 0;
      if (rate < 0) return {t, there.feature};

      if (rate == 0 && acceleration < 0 && -acceleration <= unsure) {
        // Rounding of the acceleration takes the path no deeper than rounding of positions.
        least = sqrt(closed / unsure);
      } else if (rate == 0 && (acceleration < 0 || way.descent(n, t, 0, 0, horizon - t) == 0)) {
        if (acceleration + bending(world, a, xa, b, xb, there, w) <= 0) return {t, there.feature};
        // The surface turns away faster than the path bends towards it.
        const double size = world.radius[a];
        least = 0x1p-26 * min(size / w.norm(), sqrt(size / std::abs(acceleration)));
      }
      gap = 0;
    }

    const double on = max(way.descent(n, t, gap, rate, max(horizon - t, least)), least);
    if (on == never) return {never, no_feature};
    // The clock is too coarse to come nearer.
    if (t + on == t && there.gap > closed) return {t, there.feature};
    t += on;
  }

  return {never, no_feature};
}

/// The same for a ball and a shell, piece by piece. One polynomial is accurate in each.
template <typename Way>
FeatureTime meet_shell(const Way& way, const World& world, Entity a, Entity b, const Vec3& d, double speeds,
                       uint8_t left, double horizon) {
  const Shell shell(world.obstacle(b));
  const double r = world.volume_of(a).half.x();
  for (double t = 0; t < horizon;) {
    const double length = min(horizon - t, way.span(t));
    const FeatureTime first = shell.contact_time(r, d + way.displacement(t), way.displacement_from(t, length), length,
                                                 speeds, t == 0 ? left : no_feature, length);
    if (first.time < never) return {t + first.time, first.feature};
    if (!(t + length > t)) break;
    t += length;
  }
  return {never, no_feature};
}

template <typename Way>
FeatureTime time_of_impact_along(const Way& way, const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb,
                                 double speeds, uint8_t left, double horizon) {
  const RelativeMotion start{xb - xa, way.velocity(0), way.acceleration(0), speeds, left != no_feature};
  const double far = xa.cwiseAbs().sum() + xb.cwiseAbs().sum();

  const PairKind kind = pair_kind(world, a, b);
  switch (kind) {
    case PairKind::spheres:
    case PairKind::half_space:
    case PairKind::sphere_wall:
      return meet_round(way, world, a, xa, b, xb, speeds, left, horizon);

    case PairKind::shell:
      return meet_shell(way, world, a, b, xb - xa, speeds, left, horizon);
    case PairKind::string:
      return {never, no_feature};
    default:
      return with_sum(kind, world, a, b, [&](const auto& sum, const Frame& frame) {
        return ConservativeAdvancement(sum, in_frame(frame, start), way.in(frame), far, horizon).run(left);
      });
  }
}

}  // namespace

FeatureTime time_of_impact(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                           double speeds, uint8_t left, double horizon) {
  return time_of_impact_along(FadingWay(pa, pb), world, a, pa.x, b, pb.x, speeds, left, horizon);
}

FeatureTime time_of_impact(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb,
                           const PolynomialPath::Terms& displacement, double length, double speeds, uint8_t left,
                           double horizon) {
  return time_of_impact_along(PolynomialWay(displacement, length), world, a, xa, b, xb, speeds, left, horizon);
}

double taut_time(const Vec3& d, const PolynomialPath::Terms& displacement, double length, double s, double speeds,
                 bool just_separated, double horizon) {
  return distance_time(d, displacement, length, s, Side::inside, speeds, just_separated, horizon);
}

FeatureTime leave_feature(const World& world, Entity a, const FadingPath& pa, Entity b, const FadingPath& pb,
                          uint8_t feature, double horizon) {
  const FadingWay way(pa, pb);
  const double least = 0x1p-50 * world.radius[a];

  // m: the allowed difference between the path and its parabola.
  double room = 0x1p-20 * world.radius[a];
  double t = 0, before = 0;

  while (t < horizon) {
    const Vec3 w = way.velocity(t);
    const double jerk = way.jerk(t);
    const double length = jerk > 0 ? min(horizon - t, cube_root(6 * room / jerk)) : horizon - t;
    const RelativeMotion m{pb.x - pa.x + way.displacement(t), w, way.acceleration(t), w.cwiseAbs().sum(), true};
    const FeatureTime rim = leave_feature(world, a, b, feature, m, length);

    if (rim.time == never) {
      before = t;
      t += length;
      // The rim was within the last parabola's error.
    } else if (rim.time == 0 && before < t && room > least) {
      t = before;
      room *= 0x1p-9;
    } else if (jerk * rim.time * rim.time * rim.time <= 6 * least) {
      return {t + rim.time, rim.feature};
    } else {
      before = t;
      t += 0.75 * rim.time;
    }
  }

  return {never, no_feature};
}

}  // namespace carom
