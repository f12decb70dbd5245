#pragma once
// A small picture with opacity, to be laid onto the pictures of a run.

#include "overlay/font.h"
#include "render/image.h"
#include "scene/colors.h"
#include "std.h"

namespace carom {

/// The colour of text in pictures.
inline constexpr Color text_color{1, 1, 1};

/// Colours are blended as they are encoded (sRGB), as text on screens is.
class Canvas {
 public:
  Canvas(int width, int height);

  int width() const { return width_; }    // pixels
  int height() const { return height_; }  // pixels

  /// A soft dark ground for white text. It covers everything but a margin of `feather` pixels, in which it fades out.
  void add_plate(double feather);
  /// The part `coverage` of each pixel. It must have the canvas' size.
  void add(const Coverage& coverage, const Color& color);
  /// One pixel. `opacity`: 0 to 255.
  void add(int x, int y, const Color& color, int opacity = 255) { add(pixel(x, y), Bytes(color), opacity); }

  /// Lays the canvas onto a picture, its upper left corner at (left, top). All of it must lie inside.
  void lay_onto(Image& image, int left, int top) const;

 private:
  /// A colour of three bytes.
  struct Bytes {
    explicit Bytes(const Color& color);
    array<uint32_t, 3> rgb;
  };
  struct Pixel {
    array<uint8_t, 3> rgb{};  // sRGB, times the opacity
    uint8_t opacity = 0;
  };

  Pixel& pixel(int x, int y) { return pixels_[size_t(y) * size_t(width_) + size_t(x)]; }
  static void add(Pixel& pixel, const Bytes& color, int opacity);

  int width_, height_;
  vector<Pixel> pixels_;  // top row first
};

}  // namespace carom
