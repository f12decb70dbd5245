#pragma once
// Random numbers that are the same on every machine. They use only integers, + - * / and sqrt.
// The standard library's distributions differ between implementations, and glibc's log, sin and cos between processors.

#include "std.h"

namespace carom {

/// SplitMix64 (Steele, Lea & Flood 2014). The state is one 64-bit word, and every seed is a good one.
class Random {
 public:
  /// Streams with different names are independent of one another.
  Random(uint64_t seed, string_view stream);

  /// Passes over so many of the numbers to come. It costs nothing.
  Random& skip(uint64_t count);

  uint64_t bits();
  /// Uniform: 0 <= u < 1, a multiple of 2^-53.
  double uniform() { return double(bits() >> 11) * 0x1p-53; }
  /// Uniform over 0 .. n - 1. n > 0.
  uint64_t below(uint64_t n);
  /// Normal deviate, mean 0 and standard deviation 1 (Marsaglia's polar method).
  double normal();

 private:
  uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Natural logarithm of x, 0 < x <= 1, with a relative error below 2.5 * 2^-52.
/// It is computed as ln x = e ln 2 + 2 artanh((m - 1) / (m + 1)) with x = m 2^e.
double reproducible_log(double x);

}  // namespace carom
