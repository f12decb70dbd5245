#pragma once
// The curve between linear light and its encoding, both 0 to 1 (IEC 61966-2-1).
#include <cmath>

namespace carom {

inline double light_of_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline double srgb_of_light(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace carom
