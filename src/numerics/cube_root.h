#pragma once
// The cube root with the same bits on every machine, which std::cbrt does not promise.
#include <cmath>

namespace carom {

/// x^(1/3) for finite x > 0, to a unit in the last place: y^3 = m by Newton's method, m in [1/2, 4), times a power of
/// two.
inline double cube_root(double x) {
  int exponent;
  double m = std::frexp(x, &exponent);  // m in [1/2, 1)
  while (exponent % 3 != 0) {
    m *= 2;
    --exponent;
  }
  double y = 1.25;
  for (int k = 0; k < 8; ++k) y -= (y - m / (y * y)) / 3;
  return std::ldexp(y, exponent / 3);
}

}  // namespace carom
