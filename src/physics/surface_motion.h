#pragma once
// Fixed things that move: at constant velocities in windows of time. Outside the windows a thing stands where it has
// arrived. Its motion is a list of legs, and each leg starts from an exact sum of those before it. Positions therefore
// have no error that grows. On a plane only the velocity along its normal has an effect, because there is no friction.

#include "numerics/compensated.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// A window of time in which a fixed thing moves.
struct MotionWindow {
  double from = 0;                // s
  double until = infinity;        // s
  Vec3 velocity = Vec3(0, 0, 0);  // m/s
};

/// A time from which on a fixed thing has a constant velocity, which may be zero. It lasts until the next leg starts.
struct MotionLeg {
  double from;     // s
  Vec3 velocity;   // m/s
  Vec3 start;      // m, the displacement since time 0 at `from`
  Vec3 start_low;  // m, the digits of it that `start` lacks
};

/// The legs of windows in order that do not overlap. None: the thing never moves.
vector<MotionLeg> legs_of(span<const MotionWindow> windows);

/// The leg of a fixed thing that moves at a time (s).
const MotionLeg& leg_at(const vector<MotionLeg>& legs, const DoubleDouble& time);
/// The displacement since time 0 (m) on this leg, at a time (s), added to `from` (m). It is rounded once.
Vec3 place_on(const Vec3& from, const MotionLeg& leg, const DoubleDouble& time);

}  // namespace carom
