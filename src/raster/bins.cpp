// Sorts solids into tiles by counting. Solids are sorted by depth first, so that each tile has its own from front to
// back, and can end where all its pixels are covered.
#include "raster/bins.h"

#include <numeric>

#include "std.h"

namespace carom::raster {
namespace {

/// Tiles, ends excluded.
PixelBounds in_tiles(const PixelBounds& b) {
  if (b.empty()) return {};
  const auto tile = [](int pixel) { return int16_t(pixel / tile_side); };
  return {tile(b.left), tile(b.top), tile(b.right - 1 + tile_side), tile(b.bottom - 1 + tile_side)};
}

PixelBounds joined(const PixelBounds& a, const PixelBounds& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

}  // namespace

void Bins::fill(const Shot& shot, const Silhouettes& silhouettes) {
  columns_ = (shot.lens.width + tile_side - 1) / tile_side;
  rows_ = (shot.lens.height + tile_side - 1) / tile_side;

  const auto count = uint32_t(shot.solids.size());
  tiles_.resize(count);
  around_.resize(count);
  nearest_.resize(count);
  largest_around_ = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const Solid& solid = shot.solids[i];
    const float nearest = silhouettes.of(i).nearest;
    nearest_[i] = nearest;
    tiles_[i] = in_tiles(silhouettes.of(i).bounds);

    // Of balls smaller than a pixel the darkening is not seen.
    const bool takes = solid.kind != SolidKind::wall && !solid.shell && solid.radius > shot.lens.pixel * nearest;
    around_[i] = {solid.center, takes ? solid.radius : 0};
    largest_around_ = std::max(largest_around_, around_[i].radius);

    if (takes)
      tiles_[i] = joined(tiles_[i], in_tiles(bounds_of_ball(shot.lens, solid.center, closeness * solid.radius)));
  }
  order_.sort(nearest_);

  start_.assign(size_t(columns_) * size_t(rows_) + 1, 0);
  const auto each_tile = [&](uint32_t i, auto visit) {
    const PixelBounds& b = tiles_[i];
    for (int y = b.top; y < b.bottom; ++y)
      for (int x = b.left; x < b.right; ++x) visit(size_t(y * columns_ + x));
  };

  for (uint32_t i = 0; i < count; ++i) each_tile(i, [&](size_t tile) { ++start_[tile + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());

  members_.resize(start_.back());
  next_.assign(start_.begin(), start_.end() - 1);
  for (const uint32_t i : order_.numbers()) each_tile(i, [&](size_t tile) { members_[next_[tile]++] = i; });
}

}  // namespace carom::raster
