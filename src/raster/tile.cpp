// The kernel in each vector width.
#include "raster/tile.h"

#include <cstring>

#include "numerics/srgb.h"
#include "numerics/vectors.h"
#include "raster/tile_memory.h"
#include "std.h"

#define FORCED_MEMBER inline __attribute__((always_inline))

namespace carom::raster {

#define KERNEL_FILE "raster/kernel.inc"
#include "numerics/each_width.inc"

vector<TileKernel> tile_kernels() {
  return EACH_WIDTH(draw);
}

void draw_tile(const Picture& picture, TileMemory& memory, int tile) {
  static const TileKernel widest = tile_kernels().back();
  widest(picture, memory, tile);
}

}  // namespace carom::raster
