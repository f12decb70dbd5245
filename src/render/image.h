#pragma once
// A picture in memory. The renderer makes it, and the exports write it.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

struct Image {
  int width = 0, height = 0;          // pixels
  std::vector<std::uint8_t> pixels;   // RGB, 3 bytes a pixel, top row first, sRGB-encoded
  std::vector<std::uint8_t> alpha{};  // opacity, 1 byte a pixel; colours are not multiplied by it; empty: opaque

  const std::uint8_t* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 3;
  }
};

}  // namespace carom
