// sRGB bytes become linear light of 16 bits by a table, and the mean becomes bytes by another (IEC 61966-2-1). Sixteen
// bits tell all bytes apart: the darkest two differ by 20.
#include "overlay/light_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carom {
namespace {

constexpr double most = 65535;

double linear_part(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double srgb_part(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

const std::array<std::uint16_t, 256>& light_of_bytes() {
  static const auto table = [] {
    std::array<std::uint16_t, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<std::uint16_t>(std::lround(most * linear_part(static_cast<double>(i) / 255)));
    return values;
  }();
  return table;
}

const std::vector<std::uint8_t>& bytes_of_light() {
  static const auto table = [] {
    std::vector<std::uint8_t> values(65536);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<std::uint8_t>(std::lround(255 * srgb_part(static_cast<double>(i) / most)));
    return values;
  }();
  return table;
}

}  // namespace

void LightMean::add(const Image& image) {
  const std::size_t pixels = image.pixels.size() / 3;
  if (count_++ == 0) {
    mean_.width = image.width;
    mean_.height = image.height;
    light_.assign(image.pixels.size(), 0);
    opacity_.assign(image.alpha.size(), 0);
  }
  const std::array<std::uint16_t, 256>& light = light_of_bytes();
  if (image.alpha.empty()) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) light_[i] += light[image.pixels[i]];
    return;
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t opacity = image.alpha[i];
    opacity_[i] += opacity;
    for (std::size_t c = 0; c < 3; ++c) light_[3 * i + c] += (light[image.pixels[3 * i + c]] * opacity + 127) / 255;
  }
}

const Image& LightMean::take() {
  const auto count = static_cast<std::uint32_t>(std::max(count_, 1));
  const std::vector<std::uint8_t>& bytes = bytes_of_light();
  mean_.pixels.resize(light_.size());
  mean_.alpha.resize(opacity_.size());
  if (opacity_.empty()) {
    for (std::size_t i = 0; i < light_.size(); ++i) mean_.pixels[i] = bytes[(light_[i] + count / 2) / count];
  } else {
    for (std::size_t i = 0; i < opacity_.size(); ++i) {
      mean_.alpha[i] = static_cast<std::uint8_t>((opacity_[i] + count / 2) / count);
      const double whole = std::max(opacity_[i] / 255.0, 1e-9);
      for (std::size_t c = 0; c < 3; ++c)
        mean_.pixels[3 * i + c] =
            bytes[static_cast<std::size_t>(std::min(most, std::round(light_[3 * i + c] / whole)))];
    }
  }
  count_ = 0;
  return mean_;
}

}  // namespace carom
