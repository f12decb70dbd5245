#pragma once
// Threads that draw the tiles of a picture together. The bytes do not depend on their number.
#include <memory>

#include "raster/tile.h"

namespace carom::raster {

/// The number of threads to draw by: that of LP_NUM_THREADS, which OSMesa obeys too, where it is set (0 counts as 1),
/// and that of the processors elsewhere.
int drawing_threads();

class Threads {
 public:
  /// Starts `count` - 1 threads, or as many as the system has left.
  explicit Threads(int count);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// Draws tiles 0 to count - 1.
  void draw(const Picture& picture, int count);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom::raster
