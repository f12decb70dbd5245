// The kernel in each vector width.
#include "raster/tile.h"

#include <cstring>

#include "numerics/processor.h"
#include "numerics/srgb.h"
#include "raster/tile_memory.h"
#include "std.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

#define FORCED static inline __attribute__((always_inline))
#define FORCED_MEMBER inline __attribute__((always_inline))

namespace carom::raster {

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

vector<TileKernel> tile_kernels() {
#ifdef __x86_64__
  vector<TileKernel> kernels{bits128::draw};
  if (has_avx2()) kernels.push_back(bits256::draw);
  if (has_avx512()) kernels.push_back(bits512::draw);
  return kernels;
#else
  return {any_processor::draw};
#endif
}

void draw_tile(const Picture& picture, TileMemory& memory, int tile) {
  static const TileKernel widest = tile_kernels().back();
  widest(picture, memory, tile);
}

}  // namespace carom::raster
