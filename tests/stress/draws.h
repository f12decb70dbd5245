#pragma once
// The numbers that a random scene is made of: from given bytes while they last, then from a seed.

#include "simulate/random.h"
#include "std.h"

namespace carom::stress {

class Draws {
 public:
  explicit Draws(uint64_t seed, string_view bytes = {}) : random_(seed), bytes_(bytes) {}

  double operator()(double low, double high) {
    if (bytes_.size() < 2) return random_(low, high);
    const unsigned k = static_cast<unsigned char>(bytes_[0]) + 256u * static_cast<unsigned char>(bytes_[1]);
    bytes_.remove_prefix(2);
    return low + (high - low) * (k * 0x1p-16);
  }

 private:
  Random random_;
  string_view bytes_;
};

}  // namespace carom::stress
