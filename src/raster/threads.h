#pragma once
// Threads that draw the tiles of a picture together. The bytes do not depend on their number.

#include "numerics/team.h"
#include "raster/tile.h"
#include "raster/tile_memory.h"
#include "std.h"

namespace carom::raster {

/// The number of threads to draw by: that of LP_NUM_THREADS, which OSMesa obeys too, where it is set (0 counts as 1),
/// and that of the processors elsewhere.
int drawing_threads();

class Threads {
 public:
  /// Starts `count` - 1 threads, or as many as the system has left.
  explicit Threads(int count) : team_(count), memories_(size_t(team_.size())) {}

  /// One part of a task, by its number. The memory is the thread's own.
  using Task = function<void(TileMemory& memory, int part)>;
  /// Does parts 0 to count - 1 in any order, and returns when all are done. A task throws nothing.
  void run(int count, const Task& task);
  /// Draws all tiles.
  void draw(const Picture& picture);

 private:
  Team team_;
  vector<TileMemory> memories_;  // by thread
};

}  // namespace carom::raster
