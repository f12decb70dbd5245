#pragma once
// A small picture with opacity, to be laid onto the pictures of a run.
#include <cstdint>
#include <vector>

#include "overlay/font.h"
#include "render/image.h"
#include "scene/colors.h"

namespace carom {

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
  /// One pixel.
  void add(int x, int y, const Color& color, double opacity);

  /// Lays the canvas onto a picture, its upper left corner at (left, top). All of it must lie inside.
  void lay_onto(Image& image, int left, int top) const;

 private:
  struct Pixel {
    float r = 0, g = 0, b = 0;  // sRGB, 0 to 255, times the opacity
    float opacity = 0;          // 0 to 1
  };
  int width_, height_;
  std::vector<Pixel> pixels_;  // top row first
};

}  // namespace carom
