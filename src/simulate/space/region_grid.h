#pragma once
// Regions in unbounded space, found by position. Each octave of half widths has a grid of its own. Its cells are as
// wide as its widest regions. A region is stored in the cell of its centre. A grid has about as many cells as its
// contents need. It continues after its last cell with its first, so that it has no bounds and empty space costs
// nothing. A search may therefore return distant regions as well as near ones.

#include "numerics/large_pages.h"
#include "physics/entity.h"
#include "simulate/space/region.h"
#include "std.h"

namespace carom {

class RegionGrid {
 public:
  /// `low`, `high`: the approximate extent of the space in use.
  void start(const Region& low, const Region& high);
  /// Announces the number of regions to come.
  void expect(int level, size_t regions);

  /// `regions`: by body.
  void put(Entity i, span<const Region> regions, int level);
  void remove(Entity i, const Region& region, int level);
  /// Moves a body from its former region `from`.
  void move(Entity i, const Region& from, int from_level, span<const Region> regions, int to_level);

  /// Writes all bodies with regions that may touch the given one, and perhaps others. Returns their number.
  /// `found` grows as needed, with room for `slack` more entries after the last.
  size_t near(const Region& region, vector<Entity>& found) const;
  static constexpr size_t slack = 16;

  void keep(auto& archive) { archive(low_, high_, octaves_, overflow_, free_); }

 private:
  using Cell = int64_t;
  struct alignas(64) Bucket {
    static constexpr uint32_t room = 14;
    uint32_t count = 0;
    uint32_t next = 0;  // of the overflow: its number plus one; 0: none
    Entity body[room];
  };
  struct Octave {
    int number;
    float half;        // of its widest region
    double per_width;  // cells per unit of width
    Cell low[3];       // the first cell of the space in use
    int64_t cells[3];  // along each axis
    LargeVector<Bucket> buckets;
    // Number of regions, and the number from which on more cells are better.
    size_t regions = 0, most = 0;

    void keep(auto& archive) { archive(number, half, per_width, low, cells, buckets, regions, most); }
  };

  static Cell cell_of(float x, double per_width);
  static int64_t wrap(Cell c, Cell low, int64_t cells);
  Octave& octave_of(int level);
  void shape(Octave& grid, size_t regions);
  Bucket& bucket_of(Octave& grid, const Region& region);
  void link(Bucket& first, Entity i);
  void unlink(Bucket& first, Entity i);
  void take(const Bucket* from, const Bucket* end, size_t most, size_t& count, vector<Entity>& found) const;
  void grow(Octave& grid, span<const Region> regions);

  Region low_, high_;
  vector<Octave> octaves_;
  LargeVector<Bucket> overflow_;
  vector<uint32_t> free_;  // of the overflow, numbers plus one
};

}  // namespace carom
