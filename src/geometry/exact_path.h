#pragma once
// The position on a path of degree two in double-double, exact for the given doubles to a part in 2^100. The time of a
// grazing contact is then as exact as its data.

#include "geometry/relative_motion.h"
#include "numerics/compensated.h"
#include "std.h"

namespace carom {

/// d + w t + a t^2/2.
inline array<DoubleDouble, 3> exact_position(const RelativeMotion& m, double t) {
  const DoubleDouble half_square = two_product(0.5 * t, t);
  array<DoubleDouble, 3> p;
  for (int k = 0; k < 3; ++k)
    p[size_t(k)] = DoubleDouble{m.d[k], 0} + (two_product(t, m.w[k]) + half_square * DoubleDouble{m.a[k], 0});
  return p;
}

}  // namespace carom
