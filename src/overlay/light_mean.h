#pragma once
// The mean of pictures in linear light.

#include "render/image.h"
#include "std.h"

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
  /// By byte of a picture: linear light of 65535 times opacity, and opacity of 255, summed.
  vector<uint32_t> sums_;
};

}  // namespace carom
