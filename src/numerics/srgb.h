#pragma once
// The curve between linear light and its encoding, both 0 to 1 (IEC 61966-2-1).

#include "std.h"

namespace carom {

inline double light_of_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

inline double srgb_of_light(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/// Bytes of the encoding by the root of the light, which spreads the dark values: index 0 to `steps` for 0 to 1.
struct SrgbBytes {
  static constexpr int steps = 1 << 14;
  array<uint8_t, steps + 1> of_root{};
  SrgbBytes() {
    for (int i = 0; i <= steps; ++i) {
      const double root = double(i) / steps;
      of_root[size_t(i)] = uint8_t(std::lround(255 * srgb_of_light(root * root)));
    }
  }
};

/// Computed for the first picture: it takes as long as a small run.
inline const SrgbBytes& srgb_bytes() {
  static const SrgbBytes bytes;
  return bytes;
}

}  // namespace carom
