#pragma once
// Regions in unbounded space, found by place. Each octave of half widths has a grid of its own, whose cells are as wide
// as its widest regions; a region is kept in the cell of its middle. A grid has about as many cells as it needs for
// what is in it, and goes on from its last cell with its first, so that it has no bounds and empty space costs nothing:
// what is far off may come along with what is near.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/entity.h"
#include "simulate/large_pages.h"
#include "simulate/region.h"

namespace carom {

class RegionGrid {
 public:
  /// `low`, `high`: what space is in use, more or less.
  void start(const Region& low, const Region& high);
  /// So many regions are to come.
  void expect(int level, std::size_t regions);

  /// `regions`: by body.
  void put(Entity i, std::span<const Region> regions, int level);
  void remove(Entity i, const Region& region, int level);
  /// From a region that it had before.
  void move(Entity i, const Region& from, int from_level, std::span<const Region> regions, int to_level);

  /// Writes all whose regions may touch the given one, and others; gives how many. `found` grows as needed; behind the
  /// last it has room for `slack` more.
  std::size_t near(const Region& region, std::vector<Entity>& found) const;
  static constexpr std::size_t slack = 16;

 private:
  using Cell = std::int64_t;
  struct alignas(64) Bucket {
    static constexpr std::uint32_t room = 14;
    std::uint32_t count = 0;
    std::uint32_t next = 0;  // of the overflow: its number and one; 0: none
    Entity body[room];
  };
  struct Octave {
    int number;
    float half;             // of its widest
    double per_width;       // cells
    Cell low[3];            // the cell that space in use begins with
    std::int64_t cells[3];  // along each axis
    LargeVector<Bucket> buckets;
    std::size_t regions = 0, most = 0;  // in it; and from how many on more cells are better
  };

  static Cell cell_of(float x, double per_width);
  static std::int64_t wrap(Cell c, Cell low, std::int64_t cells);
  Octave& octave_of(int level);
  void shape(Octave& grid, std::size_t regions);
  Bucket& bucket_of(Octave& grid, const Region& region);
  void link(Bucket& first, Entity i);
  void unlink(Bucket& first, Entity i);
  void take(const Bucket* from, const Bucket* end, std::size_t most, std::size_t& count,
            std::vector<Entity>& found) const;
  void grow(Octave& grid, std::span<const Region> regions);

  Region low_, high_;
  std::vector<Octave> octaves_;
  LargeVector<Bucket> overflow_;
  std::vector<std::uint32_t> free_;  // of the overflow, numbers and one
};

}  // namespace carom
