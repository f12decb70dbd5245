#pragma once
// Which solids each tile of the picture may show, and which are so near to what it shows that they take light of the
// sky there.

#include "raster/radix_sort.h"
#include "raster/silhouettes.h"
#include "std.h"

namespace carom::raster {

inline constexpr int tile_side = 32;  // pixels

/// A sphere takes cos(angle) (r / d)^2 of an even sky's light. Less than this share darkens nothing.
inline constexpr float least_taken = 1.0F / 7;
/// Within so many radii of its centre a ball takes that share: 1 / sqrt(least_taken).
inline constexpr float closeness = 2.6458F;

/// A ball around a solid that takes light of the sky from what is close to it. Radius 0: it takes none that is seen.
struct BallAround {
  Float3 center;  // m
  float radius;   // m
};

class Bins {
 public:
  /// Sorts the solids into tiles. The memory of the last picture is used again.
  void fill(const Shot& shot, const Silhouettes& silhouettes);

  int columns() const { return columns_; }
  int count() const { return columns_ * rows_; }
  /// Numbers of solids, from the nearest to the farthest.
  span<const uint32_t> tile(int i) const {
    const auto k = size_t(i);
    return {members_.data() + start_[k], start_[k + 1] - start_[k]};
  }
  const BallAround& around(uint32_t solid) const { return around_[solid]; }
  float largest_around() const { return largest_around_; }

 private:
  int columns_ = 0, rows_ = 0;
  vector<PixelBounds> tiles_;  // by solid, in tiles: where it is seen or takes light
  vector<BallAround> around_;  // by solid
  float largest_around_ = 0;   // m, of their radii
  vector<float> nearest_;      // m, by solid
  SortedNumbers order_;        // by nearest_
  vector<size_t> start_, next_;
  vector<uint32_t> members_;
};

}  // namespace carom::raster
