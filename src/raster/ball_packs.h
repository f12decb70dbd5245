#pragma once
// The solids of the light grid's cells. Balls are copied, sixteen together.

#include "raster/shot.h"
#include "std.h"

namespace carom::raster {

/// Solids by cell, in each cell from the farthest to the light to the nearest.
struct LightCells {
  vector<size_t> start;
  vector<uint32_t> members;
  span<const uint32_t> of(size_t cell) const { return {members.data() + start[cell], start[cell + 1] - start[cell]}; }
};

/// Sixteen balls of a cell, for a test of all of them at a time. Radius 0: there are fewer.
struct BallPack {
  alignas(64) array<float, 16> x, y, z, radius;  // m
  array<int32_t, 16> solid;                      // number
};

/// The balls of all cells, in the order of LightCells.
struct BallPacks {
  /// `towards_light`: by solid, as in LightGrid.
  void fill(const Shot& shot, const LightCells& balls, const vector<float>& towards_light);

  vector<uint32_t> first;  // by cell, and one more
  vector<BallPack> packs;
  /// The largest LightGrid::towards_light of a full pack; of others infinity.
  vector<float> last_place;
};

}  // namespace carom::raster
