// Sorts solids into tiles by counting. Solids are sorted by depth first, so that each tile has its own from front to
// back, and can end where all its pixels are covered.
#include "raster/bins.h"

#include <algorithm>
#include <numeric>

#include "raster/radix_sort.h"

namespace carom::raster {
namespace {

Bounds in_tiles(const Bounds& b) {
  if (b.empty()) return {};
  return {b.left / tile_side, b.top / tile_side, (b.right - 1) / tile_side + 1, (b.bottom - 1) / tile_side + 1};
}

Bounds joined(const Bounds& a, const Bounds& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

}  // namespace

void Bins::fill(Frame& frame) {
  columns_ = (frame.width + tile_side - 1) / tile_side;
  rows_ = (frame.height + tile_side - 1) / tile_side;
  const std::size_t count = frame.solids.size();
  bounds_.resize(count);
  tiles_.resize(count);
  frame.edges.clear();
  for (std::size_t i = 0; i < count; ++i) {
    Solid& solid = frame.solids[i];
    bounds_[i] = outline(frame, solid);
    tiles_[i] = in_tiles(bounds_[i]);
    if (solid.kind == Kind::wall) continue;
    // Of balls smaller than a pixel the darkening is not seen.
    if (solid.radius > frame.pixel * solid.nearest)
      tiles_[i] = joined(tiles_[i], in_tiles(bounds_of_ball(frame, solid.center, closeness * solid.radius)));
  }
  keys_.clear();
  for (const Solid& solid : frame.solids) keys_.push_back(key_of(solid.nearest));
  sort_by_key(keys_, order_, spare_);

  start_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  const auto each_tile = [&](std::uint32_t i, auto visit) {
    const Bounds& b = tiles_[i];
    for (int y = b.top; y < b.bottom; ++y)
      for (int x = b.left; x < b.right; ++x) visit(static_cast<std::size_t>(y * columns_ + x));
  };
  for (std::uint32_t i = 0; i < count; ++i) each_tile(i, [&](std::size_t tile) { ++start_[tile + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  members_.resize(start_.back());
  next_.assign(start_.begin(), start_.end() - 1);
  for (const std::uint32_t i : order_) each_tile(i, [&](std::size_t tile) { members_[next_[tile]++] = i; });
}

}  // namespace carom::raster
