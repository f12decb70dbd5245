#include "physics/path_time_of_impact.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

FeatureTime cubic_time_of_impact(const World& world, Entity a, const Path& pa, Entity b, const Path& pb, double speeds,
                                 std::uint8_t left, double horizon) {
  const Path relative{Vec3::Zero(), pb.v - pa.v, pb.a - pa.a, pb.j - pa.j};
  const double far = pa.x.cwiseAbs().sum() + pb.x.cwiseAbs().sum() + world.radius[a];
  const double closed = 0x1p-49 * far, noise = 0x1p-48 * speeds;
  double t = 0;
  for (int look = 0; look < 500 && t <= horizon; ++look) {
    const Vec3 xa = pa.x - relative.position(t);  // b stands still
    const bool leaving = t == 0 && left != no_feature;
    const Touch there = touch(world, a, xa, b, pb.x, leaving ? left : no_feature);
    const Vec3 w = relative.velocity(t);
    const Vec3& n = there.normal;
    double rate = n.dot(w);
    const double acceleration = n.dot(relative.a + t * relative.j), jerk = n.dot(relative.j);
    Polynomial gap;
    gap.degree = 3;
    double least = 0;  // s, that the path is surely outside for
    if (there.gap > closed && !leaving) {
      gap.c = {there.gap, rate, 0.5 * acceleration, jerk / 6};
    } else {
      if (std::abs(rate) <= noise) rate = 0;
      if (rate < 0) return {t, there.feature};
      if (rate == 0 && acceleration < 0) {
        if (acceleration + bending(world, a, xa, b, pb.x, there, w) <= 0) return {t, there.feature};
        // The surface turns away faster than the path bends towards it.
        const double size = world.radius[a];
        least = 0x1p-26 * std::min(size / w.norm(), std::sqrt(size / -acceleration));
      }
      gap.c = {0, rate, 0.5 * acceleration, jerk / 6};
    }
    const double on = std::max(first_descent(gap, std::max(horizon - t, least)), least);
    if (on == never) return {never, no_feature};
    if (t + on == t && there.gap > closed) return {t, there.feature};  // the clock is too coarse to come nearer
    t += on;
  }
  return {never, no_feature};
}

}  // namespace

FeatureTime time_of_impact(const World& world, Entity a, const Path& pa, Entity b, const Path& pb, std::uint8_t left,
                           double horizon) {
  const double speeds = pa.v.cwiseAbs().sum() + pb.v.cwiseAbs().sum();
  if (pa.j == pb.j)
    return time_of_impact(
        world, a, b, RelativeMotion{pb.x - pa.x, pb.v - pa.v, pb.a - pa.a, speeds, left != no_feature}, left, horizon);
  return cubic_time_of_impact(world, a, pa, b, pb, speeds, left, horizon);
}

}  // namespace carom
