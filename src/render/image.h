#pragma once
// A picture in memory. The renderer makes it, and the exports write it.

#include "std.h"

namespace carom {

struct Image {
  int width = 0, height = 0;  // pixels
  vector<uint8_t> pixels;     // `channels` bytes a pixel, top row first
  /// 3: red, green and blue, sRGB-encoded. 4: also the opacity, by which the colours are not multiplied.
  int channels = 3;

  size_t row_size() const { return size_t(width) * size_t(channels); }
  const uint8_t* row(int y) const { return pixels.data() + size_t(y) * row_size(); }
  /// Whether it has pixels, as many as its size says.
  bool is_whole() const {
    return width > 0 && height > 0 && (channels == 3 || channels == 4) && pixels.size() == size_t(height) * row_size();
  }
};

}  // namespace carom
