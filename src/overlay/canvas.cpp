// Porter and Duff's `over` in whole numbers, with colours multiplied by opacity. Each step rounds, to within one of
// 255.
#include "overlay/canvas.h"

#include "std.h"

namespace carom {
namespace {

// White text on it has a contrast of at least 5 to 1, whatever is below.
constexpr double plate_opacity = 0.6;

/// x / 255, rounded, for x up to 255 * 255.
constexpr uint8_t part_of_255(uint32_t x) {
  return uint8_t(((x + 128) * 257) >> 16);
}

}  // namespace

Canvas::Bytes::Bytes(const Color& color) {
  const double parts[] = {color.r, color.g, color.b};
  for (size_t c = 0; c < 3; ++c) rgb[c] = uint32_t(std::lround(255 * parts[c]));
}

Canvas::Canvas(int width, int height) : width_(width), height_(height), pixels_(size_t(width) * size_t(height)) {}

void Canvas::add(Pixel& pixel, const Bytes& color, int opacity) {
  const auto new_part = uint32_t(opacity), old_part = 255 - new_part;
  for (size_t c = 0; c < 3; ++c) pixel.rgb[c] = part_of_255(old_part * pixel.rgb[c] + new_part * color.rgb[c]);
  pixel.opacity = part_of_255(old_part * pixel.opacity + new_part * 255);
}

void Canvas::add_plate(double feather) {
  const auto parts_along = [feather](int size) {
    vector<double> parts(static_cast<size_t>(size));
    for (int i = 0; i < size; ++i) parts[size_t(i)] = min(1.0, (min(i, size - 1 - i) + 0.5) / max(feather, 1.0));
    return parts;
  };
  const vector<double> across = parts_along(width_), down = parts_along(height_);
  const Bytes black(Color{0, 0, 0});
  auto at = pixels_.begin();
  for (const double y : down)
    for (const double x : across) add(*at++, black, int(std::lround(255 * plate_opacity * x * y)));
}

void Canvas::add(const Coverage& coverage, const Color& color) {
  const Bytes bytes(color);
  for (size_t i = 0; i < pixels_.size(); ++i)
    if (coverage.values[i] > 0) add(pixels_[i], bytes, coverage.values[i]);
}

void Canvas::lay_onto(Image& image, int left, int top) const {
  for (int y = 0; y < height_; ++y) {
    const Pixel* above = &pixels_[size_t(y) * size_t(width_)];
    uint8_t* rgb = image.pixels.data() + size_t(top + y) * image.row_size() + size_t(left * image.channels);

    for (int x = 0; x < width_; ++x, ++above, rgb += image.channels) {
      const uint32_t rest = 255U - above->opacity;
      if (image.channels == 3) {
        for (size_t c = 0; c < 3; ++c) rgb[c] = uint8_t(above->rgb[c] + part_of_255(rest * rgb[c]));
        continue;
      }

      // Over a picture that may be transparent.
      uint8_t& alpha = rgb[3];
      const uint32_t below = part_of_255(rest * alpha), whole = above->opacity + below;
      if (whole == 0) continue;
      for (size_t c = 0; c < 3; ++c)
        rgb[c] = uint8_t(min<uint32_t>(255, (255U * above->rgb[c] + below * rgb[c] + whole / 2) / whole));
      alpha = uint8_t(whole);
    }
  }
}

}  // namespace carom
