#pragma once
// The clock of the exact simulator: a time in two doubles. An event at 1e6 s is as exact as one at 1 s. In one double,
// a ball in a box is off by 1e-6 m after 1e5 s and 4e5 events. In two doubles it is off by 1e-9 m (measured).
#include <compare>

#include "numerics/compensated.h"
#include "std.h"

namespace carom {

struct Instant {
  double hi = 0, lo = 0;  // s, hi + lo

  /// The last double that is not after it (s). A double is after the instant if it is greater than this.
  double floor() const { return lo < 0 ? std::nextafter(hi, -infinity) : hi; }

  friend bool operator==(const Instant&, const Instant&) = default;
  friend bool operator<(const Instant& a, const Instant& b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }
  friend bool operator<=(const Instant& a, const Instant& b) { return !(b < a); }
  /// Seconds from b to a.
  friend double operator-(const Instant& a, const Instant& b) { return (a.hi - b.hi) + (a.lo - b.lo); }
  friend Instant operator+(const Instant& a, double dt) {
    const DoubleDouble s = two_sum(a.hi, dt);
    const DoubleDouble t = fast_two_sum(s.hi, s.lo + a.lo);
    return {t.hi, t.lo};
  }
};

/// The time from one instant to another (s), in two doubles.
inline DoubleDouble seconds(const Instant& from, const Instant& to) {
  return DoubleDouble{to.hi, to.lo} - DoubleDouble{from.hi, from.lo};
}

}  // namespace carom
