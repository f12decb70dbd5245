// The positions of fixed things that move. A leg's start is a sum of products in double-double, so that a thousand
// windows cost no digits. The instants of windows stay those of the scene: no running time is added up.
#include "physics/surface_motion.h"

#include "std.h"

namespace carom {

namespace {

/// The displacement on a leg since time 0 (m), at a time (s), along one axis.
DoubleDouble along(const MotionLeg& leg, const DoubleDouble& time, int axis) {
  const DoubleDouble start{leg.start[axis], leg.start_low[axis]};
  if (leg.velocity[axis] == 0) return start;
  return start + (time - DoubleDouble{leg.from, 0}) * DoubleDouble{leg.velocity[axis], 0};
}

MotionLeg next_leg(const vector<MotionLeg>& legs, double from, const Vec3& velocity) {
  MotionLeg next{from, velocity, Vec3::Zero(), Vec3::Zero()};
  for (int axis = 0; axis < 3 && !legs.empty(); ++axis) {
    const DoubleDouble at = along(legs.back(), {from, 0}, axis);
    next.start[axis] = at.hi;
    next.start_low[axis] = at.lo;
  }
  return next;
}

}  // namespace

vector<MotionLeg> legs_of(span<const MotionWindow> windows) {
  vector<MotionLeg> legs;
  const auto begin = [&](double from, const Vec3& velocity) {
    if (!legs.empty() && legs.back().velocity == velocity) return;
    // A window may start where the one before ends.
    if (!legs.empty() && legs.back().from == from)
      legs.back().velocity = velocity;
    else
      legs.push_back(next_leg(legs, from, velocity));
  };

  for (const MotionWindow& window : windows) {
    if (window.velocity.isZero(0)) continue;
    if (legs.empty() && window.from > 0) begin(0, Vec3::Zero());
    begin(window.from, window.velocity);
    if (window.until < infinity) begin(window.until, Vec3::Zero());
  }

  return legs;
}

const MotionLeg& leg_at(const vector<MotionLeg>& legs, const DoubleDouble& time) {
  const auto later = [](const DoubleDouble& t, const MotionLeg& leg) {
    return t.hi < leg.from || (t.hi == leg.from && t.lo < 0);
  };
  const auto next = std::upper_bound(legs.begin() + 1, legs.end(), time, later);
  return *(next - 1);
}

Vec3 place_on(const Vec3& from, const MotionLeg& leg, const DoubleDouble& time) {
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) x[axis] = (DoubleDouble{from[axis], 0} + along(leg, time, axis)).value();
  return x;
}

}  // namespace carom
