#pragma once
// Conversion from any double to an integer.

#include "std.h"

namespace carom {

/// The largest whole number that whole_below returns; its negative is the least.
/// It is far within int64_t, so that sums and differences of two stay in range.
inline constexpr int64_t most_whole = int64_t{1} << 61;

/// x rounded down and clamped to most_whole; 0 for NaN. A cast of a double beyond the integer's range is undefined.
inline int64_t whole_below(double x) {
  constexpr double most = 0x1p61;
  if (x >= most) return most_whole;
  if (x <= -most) return -most_whole;
  return x == x ? int64_t(floor(x)) : 0;
}

/// The same, rounded to the nearest whole number.
inline int64_t nearest_whole(double x) {
  return whole_below(x + 0.5);
}

}  // namespace carom
