#pragma once
// A body's region for the search of neighbours: a ball in single precision, a quarter of a cache line. Half widths have
// steps of a quarter octave.
#include <bit>

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct alignas(16) Region {
  float x = 0, y = 0, z = 0;  // the centre
  float half = 0;             // it contains the whole body, anywhere in its region
};

/// Whether bodies of two regions may touch. The result is symmetric.
inline bool may_touch(const Region& a, const Region& b) {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, reach = a.half + b.half;
  return dx * dx + (dy * dy + dz * dz) <= reach * reach;
}

/// A half width less the greatest rounding of single precision.
inline double sure(float half) {
  return double(half) * (1 - 0x1p-19);
}

inline constexpr int widest_level = 512;  // unbounded

/// Half width number `level`, 2^(level/4), composed of its bits.
inline float half_of_level(int level) {
  constexpr float step[] = {1, 1.1892071F, 1.4142136F, 1.6817929F};
  const int octave = level >> 2;
  if (octave > 127) return numeric_limits<float>::infinity();
  return step[level & 3] * std::bit_cast<float>(uint32_t(octave + 127) << 23);
}

/// The narrowest level with a sure half width of at least this.
inline int level_of_half(double half) {
  if (!(half < 0x1p127)) return widest_level;
  int exponent;
  // In [2^(exponent - 1), 2^exponent).
  std::frexp(half, &exponent);
  int level = 4 * (exponent - 1);
  while (sure(half_of_level(level)) < half) ++level;
  return level;
}

}  // namespace carom
