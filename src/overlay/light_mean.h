#pragma once
// The mean of pictures in linear light.
#include <cstdint>
#include <vector>

#include "render/image.h"

namespace carom {

/// Sums pictures of one size. A channel of the mean is within half a step of the exact one.
class LightMean {
 public:
  /// Takes up to 65536 pictures.
  void add(const Image& image);
  /// The mean of the pictures added since the last call, of which there must be one. Colours count by their opacity.
  const Image& take();

 private:
  Image mean_;
  int count_ = 0;
  std::vector<std::uint32_t> light_;    // by channel of a pixel: linear light of 65535, summed
  std::vector<std::uint32_t> opacity_;  // by pixel, summed; empty: opaque
};

}  // namespace carom
