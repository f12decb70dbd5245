// Porter and Duff's `over`, with colours multiplied by opacity.
#include "overlay/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carom {
namespace {

// White text on it has a contrast of at least 5 to 1, whatever is below.
constexpr double plate_opacity = 0.6;

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Canvas::add(int x, int y, const Color& color, double opacity) {
  Pixel& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  const auto new_part = static_cast<float>(opacity), old_part = 1 - new_part;
  const auto over = [&](float below, double above) {
    return old_part * below + new_part * 255 * static_cast<float>(above);
  };
  pixel = {over(pixel.r, color.r), over(pixel.g, color.g), over(pixel.b, color.b), old_part * pixel.opacity + new_part};
}

void Canvas::add_plate(double feather) {
  const auto part = [feather](int i, int size) {
    const double inside = std::min(i, size - 1 - i) + 0.5;
    return std::min(1.0, inside / std::max(feather, 1.0));
  };
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) add(x, y, Color{0, 0, 0}, plate_opacity * part(x, width_) * part(y, height_));
}

void Canvas::add(const Coverage& coverage, const Color& color) {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (const int covered = coverage.at(x, y); covered > 0) add(x, y, color, covered / 255.0);
}

void Canvas::lay_onto(Image& image, int left, int top) const {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Pixel& above =
          pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      if (above.opacity == 0) continue;
      const std::size_t at = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(left + x);
      std::uint8_t* const rgb = image.pixels.data() + 3 * at;
      const float ground = image.alpha.empty() ? 1 : static_cast<float>(image.alpha[at]) / 255;
      const float below = (1 - above.opacity) * ground, whole = above.opacity + below;
      rgb[0] = byte((above.r + below * static_cast<float>(rgb[0])) / whole);
      rgb[1] = byte((above.g + below * static_cast<float>(rgb[1])) / whole);
      rgb[2] = byte((above.b + below * static_cast<float>(rgb[2])) / whole);
      if (!image.alpha.empty()) image.alpha[at] = byte(255 * whole);
    }
  }
}

}  // namespace carom
