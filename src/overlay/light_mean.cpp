// sRGB bytes become linear light of 16 bits by a table, and the mean becomes bytes by another (IEC 61966-2-1). Sixteen
// bits tell all bytes apart: the darkest two differ by 20.
#include "overlay/light_mean.h"

#include "numerics/srgb.h"
#include "std.h"

namespace carom {
namespace {

constexpr double most = 65535;

const array<uint16_t, 256>& light_of_bytes() {
  static const auto table = [] {
    array<uint16_t, 256> values{};
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint16_t(std::lround(most * light_of_srgb(double(i) / 255)));
    return values;
  }();
  return table;
}

const vector<uint8_t>& bytes_of_light() {
  static const auto table = [] {
    vector<uint8_t> values(65536);
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint8_t(std::lround(255 * srgb_of_light(double(i) / most)));
    return values;
  }();
  return table;
}

}  // namespace

void LightMean::add(const Image& image) {
  if (count_++ == 0) {
    mean_.width = image.width;
    mean_.height = image.height;
    mean_.channels = image.channels;
    sums_.assign(image.pixels.size(), 0);
  }

  const array<uint16_t, 256>& light = light_of_bytes();
  if (image.channels == 3) {
    for (size_t i = 0; i < image.pixels.size(); ++i) sums_[i] += light[image.pixels[i]];
    return;
  }

  // Colours count by their opacity.
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    const uint32_t opacity = image.pixels[i + 3];
    for (size_t c = 0; c < 3; ++c) sums_[i + c] += (light[image.pixels[i + c]] * opacity + 127) / 255;
    sums_[i + 3] += opacity;
  }
}

const Image& LightMean::take() {
  const auto count = uint32_t(max(count_, 1));
  const vector<uint8_t>& bytes = bytes_of_light();
  mean_.pixels.resize(sums_.size());

  if (mean_.channels == 3) {
    for (size_t i = 0; i < sums_.size(); ++i) mean_.pixels[i] = bytes[(sums_[i] + count / 2) / count];
  } else {
    for (size_t i = 0; i < sums_.size(); i += 4) {
      const double whole = max(sums_[i + 3] / 255.0, 1e-9);
      for (size_t c = 0; c < 3; ++c) mean_.pixels[i + c] = bytes[size_t(min(most, std::round(sums_[i + c] / whole)))];
      mean_.pixels[i + 3] = uint8_t((sums_[i + 3] + count / 2) / count);
    }
  }

  count_ = 0;
  return mean_;
}

}  // namespace carom
