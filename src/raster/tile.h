#pragma once
// Draws one tile of a picture: finds what each pixel shows, then the light from there. The kernel is compiled for each
// vector width and chosen by the processor at run time. All widths have the same arithmetic in the same order, so that
// the bytes do not depend on the processor.

#include "raster/bins.h"
#include "raster/light_grid.h"
#include "raster/silhouettes.h"
#include "std.h"

namespace carom::raster {

/// A stroke of the picture in front of all that is farther: a line with round ends, in pixels.
struct Line {
  float x0, y0, x1, y1;      // pixels, its ends
  float radius0, radius1;    // pixels
  float depth0, depth1;      // 1 / z at its ends, 1 / m
  Float3 color;              // linear
  float opacity0, opacity1;  // 0 to 1
  bool joined;               // begins where the last one ends
};

/// What one tile needs of a picture.
struct Picture {
  const Shot* shot;
  const Silhouettes* silhouettes;
  const Bins* bins;
  const LightGrid* lights;
  const vector<Line>* lines;                   // or nullptr
  const vector<vector<uint32_t>>* tile_lines;  // by tile
  uint8_t* pixels;                             // rows of `channels` bytes each
  int channels;                                // 3: RGB; 4: with alpha, not premultiplied
};

struct TileMemory;
using TileKernel = void (*)(const Picture& picture, TileMemory& memory, int tile);

/// The kernels that this processor can run, the widest last.
vector<TileKernel> tile_kernels();

/// Draws the tile by the widest one.
void draw_tile(const Picture& picture, TileMemory& memory, int tile);

}  // namespace carom::raster
