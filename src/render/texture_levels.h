#pragma once
// Coarser versions of a texture, in linear light: the mean of what a place shows from afar.

#include "render/mesh_data.h"
#include "std.h"

namespace carom {

/// The same picture with other sides, neither longer than before. A pixel is the mean over its area in linear light,
/// weighted by opacity.
MeshTexture reduced(const MeshTexture& texture, uint32_t width, uint32_t height);

/// The coarser levels down to one pixel. Each side is half of the one before, rounded down, and at least 1.
vector<MeshTexture> coarser_levels(const MeshTexture& texture);

/// Red, green and blue of a pixel in linear light, and its opacity, 0 to 1.
array<float, 4> light_of(const MeshTexture& texture, uint32_t x, uint32_t y);

}  // namespace carom
