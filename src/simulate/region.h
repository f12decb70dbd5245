#pragma once
// A body's region as its neighbours are found by: a ball, in single precision, a quarter of a cache line. Its half
// widths come in steps of a quarter octave.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "numerics/vec3.h"

namespace carom {

struct alignas(16) Region {
  float x = 0, y = 0, z = 0;  // the middle
  float half = 0;             // with the body in it, wherever it is
};

/// Whether bodies of two regions may touch. The same either way round.
inline bool may_touch(const Region& a, const Region& b) {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, reach = a.half + b.half;
  return dx * dx + (dy * dy + dz * dz) <= reach * reach;
}

/// What of a half width is sure, with all that single precision rounds.
inline double sure(float half) {
  return static_cast<double>(half) * (1 - 0x1p-19);
}

inline constexpr int widest_level = 512;  // without end

/// Half width number `level`: 2^(level/4), made of its bits.
inline float half_of_level(int level) {
  constexpr float step[] = {1, 1.1892071F, 1.4142136F, 1.6817929F};
  const int octave = level >> 2;
  if (octave > 127) return std::numeric_limits<float>::infinity();
  return step[level & 3] * std::bit_cast<float>(static_cast<std::uint32_t>(octave + 127) << 23);
}

/// The narrowest level whose sure half width is at least this.
inline int level_of_half(double half) {
  if (!(half < 0x1p127)) return widest_level;
  int exponent;
  std::frexp(half, &exponent);  // in [2^(exponent - 1), 2^exponent)
  int level = 4 * (exponent - 1);
  while (sure(half_of_level(level)) < half) ++level;
  return level;
}

}  // namespace carom
