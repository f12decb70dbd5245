#pragma once
// The cube root with the same bits on every machine, which std::cbrt does not promise.

#include "std.h"

namespace carom {

/// x^(1/3) for finite x > 0, to a unit in the last place.
/// x is m times a power of two, m in [1/2, 4). Newton's method solves y^3 = m.
inline double cube_root(double x) {
  int exponent;
  // m in [1/2, 1)
  double m = std::frexp(x, &exponent);
  while (exponent % 3 != 0) {
    m *= 2;
    --exponent;
  }
  double y = 1.25;
  for (int k = 0; k < 8; ++k) y -= (y - m / (y * y)) / 3;
  return std::ldexp(y, exponent / 3);
}

}  // namespace carom
