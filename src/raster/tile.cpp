// The kernel in each vector width.
#include "raster/tile.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "numerics/processor.h"
#include "raster/tile_data.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

#define FORCED static inline __attribute__((always_inline))
#define FORCED_MEMBER inline __attribute__((always_inline))

namespace carom::raster {

namespace {

/// Bytes of the sRGB curve, by the root of the light, which spreads the dark values.
struct Encoding {
  static constexpr int steps = 1 << 14;
  std::array<std::uint8_t, steps + 1> bytes{};
  Encoding() {
    for (int i = 0; i <= steps; ++i) {
      const double root = static_cast<double>(i) / steps, x = root * root;
      const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
      bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255 * y));
    }
  }
};
const Encoding encoding;

}  // namespace

#ifdef __x86_64__
namespace bits128 {
#define WIDTH 128
#include "raster/kernel.inc"
#undef WIDTH
}  // namespace bits128

CAROM_BEGIN_AVX2
namespace bits256 {
#define WIDTH 256
#include "raster/kernel.inc"
#undef WIDTH
}  // namespace bits256
CAROM_END_TARGET

CAROM_BEGIN_AVX512
namespace bits512 {
#define WIDTH 512
#include "raster/kernel.inc"
#undef WIDTH
}  // namespace bits512
CAROM_END_TARGET
#else
namespace any_processor {
#define WIDTH 0
#include "raster/kernel.inc"
#undef WIDTH
}  // namespace any_processor
#endif

TileMemory::TileMemory() : data_(std::make_unique<Data>()) {}
TileMemory::~TileMemory() = default;

std::vector<TileKernel> tile_kernels() {
#ifdef __x86_64__
  std::vector<TileKernel> kernels{bits128::draw};
  if (has_avx2()) kernels.push_back(bits256::draw);
  if (has_avx512()) kernels.push_back(bits512::draw);
  return kernels;
#else
  return {any_processor::draw};
#endif
}

void draw_tile(const Picture& picture, TileMemory& memory, int tile) {
  static const TileKernel widest = tile_kernels().back();
  widest(picture, memory.data(), tile);
}

std::uint8_t srgb_byte(float light) {
  const float root = std::sqrt(std::min(std::max(light, 0.0F), 1.0F));
  return encoding.bytes[static_cast<std::size_t>(std::lround(root * Encoding::steps))];
}

}  // namespace carom::raster
