#pragma once
// Strokes of a picture as lines in pixels, sorted into its tiles.

#include "raster/tile.h"
#include "render/drawing.h"
#include "render/eye.h"
#include "std.h"

namespace carom {

struct Lines {
  vector<raster::Line> all;
  vector<vector<uint32_t>> by_tile;  // numbers, in order

  /// Empties them.
  void begin(Size picture);
  /// Strokes before the near plane are cut off there. A stroke that begins where the last one ends is joined to it.
  void add(const vector<Stroke>& strokes, const Eye& eye);
};

}  // namespace carom
