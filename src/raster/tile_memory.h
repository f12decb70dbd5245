#pragma once
// What is known of a tile while it is drawn. A tile has blocks of 4 x 4 pixels, one for each vector; pixel i of block b
// is number 16 b + i.

#include "raster/bins.h"
#include "std.h"

namespace carom::raster {

inline constexpr int tile_pixels = tile_side * tile_side;
inline constexpr int block_side = 4;
inline constexpr int blocks_across = tile_side / block_side;
inline constexpr int blocks = blocks_across * blocks_across;
/// The nearest solids that a pixel shows. Behind so many that cover it in part, farther ones are not seen.
inline constexpr int most_layers = 6;

/// Bits of a layer's solid number.
inline constexpr int32_t seen_inside = 1 << 30;  // cut open by the near plane
inline constexpr int32_t number_mask = seen_inside - 1;
inline constexpr int32_t no_solid = number_mask;

/// Solids near a tile, as arrays for a test of many at a time. Their length is a multiple of 16.
struct Nearby {
  vector<float> x, y, z, radius;  // m, of a ball around each
  vector<uint32_t> solid;
  size_t count = 0;
  void clear() {
    for (auto* a : {&x, &y, &z, &radius}) a->clear();
    solid.clear();
    count = 0;
  }
};

/// What pixels show, by block, layer, pixel of the block, sorted by depth.
struct TileLayers {
  alignas(64) array<float, tile_pixels * most_layers> depth;  // z
  alignas(64) array<float, tile_pixels * most_layers> cover;  // share of the pixel; then its share of the light
  alignas(64) array<int32_t, tile_pixels * most_layers> solid;
  // By pixel.
  alignas(64) array<float, tile_pixels> opaque;  // z of the nearest solid that covers all of it
  alignas(64) array<float, tile_pixels> clear;   // share that no solid covers
  // By block.
  array<float, blocks> block_opaque;  // the largest of `opaque`
  array<int, blocks> used;            // layers
  array<bool, blocks> overfull;
};

/// Linear light by pixel.
struct TilePixels {
  alignas(64) array<float, tile_pixels> red, green, blue, alpha;
  alignas(64) array<float, tile_pixels> inverse;                          // 1 / z of what has the largest share
  alignas(64) array<float, tile_pixels> line;                             // share of joined lines
  alignas(64) array<float, tile_pixels> line_red, line_green, line_blue;  // of the one with this share
};

/// Parts of layers that do not fill a block, to be lit together.
struct LightQueue {
  alignas(64) array<int32_t, tile_pixels * most_layers> places;  // index into the arrays of TileLayers
  alignas(64) array<int32_t, tile_pixels * most_layers> sorted;  // the same, by solid
  int count = 0;
  vector<uint32_t> slot, slot_mark;  // by solid: its number among those of the queue
  vector<int> slot_end;              // by slot
};

/// The solids that take light from the tile's points.
struct TileNeighbours {
  Nearby shading, close;  // of the key light; of the sky's
  bool crowd = false;     // balls shade by the light grid's cells; `shading` has the other solids
  vector<uint32_t> found;
  vector<uint32_t> cells;                  // of the light grid, without repetitions
  vector<uint32_t> cell_mark, solid_mark;  // the last tile that visited it
  uint32_t mark = 0;                       // of this tile
};

/// The memory of one thread for the tiles that it draws.
struct TileMemory {
  TileLayers layers;
  TilePixels pixels;
  LightQueue queue;
  TileNeighbours near;
};

}  // namespace carom::raster
