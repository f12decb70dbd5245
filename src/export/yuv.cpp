// The formulas in fixed point with 40 bits of fraction, in 64-bit integers: the same bytes on every machine.
// The exact values are multiples of 1/850,000 or coarser, and the factors' errors add up to less than 1e-9.
// So every value is rounded as the exact one, as long as an exact half is not pulled below: `nudge` lifts it.
// (Floats misround 20 of the 2,550,001 values of luma. They are not faster without AVX2: 1.1 ms for 1280 x 720.)
#include "export/yuv.h"

#include "std.h"

namespace carom {
namespace {

constexpr int bits = 40;
constexpr int64_t one = int64_t{1} << bits;
/// More than the error of the sum of three products of at most 1020, and less than the distance of other values to 1/2.
constexpr int64_t nudge = 4096;

/// The nearest whole number; of a positive factor.
constexpr int64_t fixed(double factor) {
  return int64_t(factor * double(2 * one) + 1) / 2;
}

/// `level` + 1/2, for rounding.
constexpr int64_t above(int64_t level) {
  return level * one + one / 2 + nudge;
}

// Weights of R', G', B' in luma, in 1/10,000.
constexpr double red = 2126, green = 7152, blue = 722, whole = 10000;

constexpr double luma = 219.0 / (255 * whole);
constexpr int64_t y_red = fixed(luma * red), y_green = fixed(luma * green), y_blue = fixed(luma * blue);

// Of the sum of 4 pixels.
constexpr double cb = 112.0 / (4 * 255 * (whole - blue)), cr = 112.0 / (4 * 255 * (whole - red));
constexpr int64_t cb_red = fixed(cb * red), cb_green = fixed(cb * green), cb_blue = fixed(cb * (whole - blue));
constexpr int64_t cr_red = fixed(cr * (whole - red)), cr_green = fixed(cr * green), cr_blue = fixed(cr * blue);

/// `rgb`: `width` pixels.
void luma_row(const uint8_t* rgb, size_t width, uint8_t* y) {
  for (size_t x = 0; x < width; ++x)
    y[x] = uint8_t((rgb[3 * x] * y_red + rgb[3 * x + 1] * y_green + rgb[3 * x + 2] * y_blue + above(16)) >> bits);
}

/// `upper`, `lower`: two rows of 2 * `width` pixels.
void chroma_row(const uint8_t* upper, const uint8_t* lower, size_t width, uint8_t* u, uint8_t* v) {
  for (size_t x = 0; x < width; ++x, upper += 6, lower += 6) {
    const int64_t r = upper[0] + upper[3] + lower[0] + lower[3];
    const int64_t g = upper[1] + upper[4] + lower[1] + lower[4];
    const int64_t b = upper[2] + upper[5] + lower[2] + lower[5];
    u[x] = uint8_t((b * cb_blue - r * cb_red - g * cb_green + above(128)) >> bits);
    v[x] = uint8_t((r * cr_red - g * cr_green - b * cr_blue + above(128)) >> bits);
  }
}

/// Rows of pixels in RGB, of even width.
class RgbRows {
 public:
  RgbRows(const Image& image, size_t width) : image_(image), copy_(3 * width) {}

  /// Valid until the next call.
  const uint8_t* row(int number) {
    const uint8_t* from = image_.row(min(number, image_.height - 1));
    const auto width = size_t(image_.width);
    if (image_.channels == 3 && copy_.size() == 3 * width) return from;
    if (image_.channels == 3)
      std::copy_n(from, 3 * width, copy_.begin());
    else
      show_on_black(from, width);
    if (copy_.size() > 3 * width) std::copy_n(copy_.end() - 6, 3, copy_.end() - 3);
    return copy_.data();
  }

 private:
  void show_on_black(const uint8_t* rgba, size_t width) {
    for (size_t x = 0; x < width; ++x)
      for (size_t c = 0; c < 3; ++c) copy_[3 * x + c] = uint8_t((rgba[4 * x + c] * rgba[4 * x + 3] + 127) / 255);
  }

  const Image& image_;
  vector<uint8_t> copy_;
};

}  // namespace

Size yuv_size(const Image& image) {
  return {image.width + image.width % 2, image.height + image.height % 2};
}

void to_yuv420p(const Image& image, vector<uint8_t>& planes) {
  const Size size = yuv_size(image);
  const auto width = size_t(size.width), height = size_t(size.height);
  planes.resize(width * height * 3 / 2);

  uint8_t* y = planes.data();
  uint8_t* u = y + width * height;
  uint8_t* v = u + width * height / 4;
  RgbRows uppers(image, width), lowers(image, width);

  // Two rows at a time, since they share their colours.
  for (int number = 0; number < size.height; number += 2) {
    const uint8_t* const upper = uppers.row(number);
    const uint8_t* const lower = lowers.row(number + 1);
    luma_row(upper, width, y);
    luma_row(lower, width, y + width);
    chroma_row(upper, lower, width / 2, u, v);

    y += 2 * width;
    u += width / 2;
    v += width / 2;
  }
}

}  // namespace carom
