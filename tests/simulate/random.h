#pragma once
// The tests' own random numbers: the same on every machine.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class Random {
 public:
  explicit Random(uint64_t seed = 42) : state_(seed * 7919 + 13) {
    for (int i = 0; i < 5; ++i) (*this)(0, 1);
  }
  double operator()(double low, double high) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

/// A point of the cube of edge 2 * half around 0.
inline Vec3 in_cube(Random& random, double half) {
  const double x = random(-half, half), y = random(-half, half), z = random(-half, half);
  return {x, y, z};
}

}  // namespace carom
