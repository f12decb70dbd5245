#pragma once
// Boxes in unbounded space, found by place. Every box is kept in one cell, that of its centre, on the level whose cells are at
// least as wide as the box: levels are powers of two, so boxes of all sizes live together. Cells are hashed; empty space costs
// nothing.
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "physics/vec3.h"
#include "physics/world.h"

namespace carom {

class RegionGrid {
 public:
  explicit RegionGrid(Entity bodies) : place_(bodies) {}

  /// Puts body i's box (centre, half width) in, or moves it.
  void put(Entity i, const Vec3& center, double half);

  /// Calls visit(j) for every body whose box may overlap the given one (all that do, and some that do not).
  template <typename Visit>
  void near(const Vec3& center, double half, Visit visit) const;

 private:
  using Cell = std::int64_t;
  struct Key {
    Cell x, y, z;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      const auto mix = [](std::uint64_t h, Cell c) {
        h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ull;
        return h ^ (h >> 29);
      };
      return mix(mix(mix(0x2545F4914F6CDD1Dull, k.x), k.y), k.z);
    }
  };
  struct Place {
    int level = no_level;
    Key cell{};
    std::uint32_t slot = 0;  // in the cell's list
  };
  struct Level {
    int exponent;
    double width;  // m, of a cell
    std::size_t boxes = 0;
    std::unordered_map<Key, std::vector<Entity>, Hash> cells;
  };
  static constexpr int no_level = -1;

  int level_for(double half);
  void take_out(Entity i);
  // Far beyond 2^60 cells everything shares the outermost cell: slower there, never wrong.
  static Cell cell_of(double x, double width) {
    const double c = std::floor(x / width);
    return c < -0x1p60 ? -(Cell{1} << 60) : c > 0x1p60 ? Cell{1} << 60 : static_cast<Cell>(c);
  }

  std::vector<Level> levels_;
  std::vector<Place> place_;
};

template <typename Visit>
void RegionGrid::near(const Vec3& center, double half, Visit visit) const {
  for (const Level& level : levels_) {
    if (level.boxes == 0) continue;
    const double reach = half + 0.5 * level.width;
    Key low, high;
    low = {cell_of(center.x() - reach, level.width), cell_of(center.y() - reach, level.width),
           cell_of(center.z() - reach, level.width)};
    high = {cell_of(center.x() + reach, level.width), cell_of(center.y() + reach, level.width),
            cell_of(center.z() + reach, level.width)};
    const double cells = (static_cast<double>(high.x - low.x) + 1) * (static_cast<double>(high.y - low.y) + 1) *
                         (static_cast<double>(high.z - low.z) + 1);
    if (cells > static_cast<double>(level.cells.size())) {  // wider than what there is: look at what there is
      for (const auto& [key, boxes] : level.cells) {
        if (key.x < low.x || key.x > high.x || key.y < low.y || key.y > high.y || key.z < low.z || key.z > high.z) continue;
        for (Entity j : boxes) visit(j);
      }
      continue;
    }
    for (Cell x = low.x; x <= high.x; ++x)
      for (Cell y = low.y; y <= high.y; ++y)
        for (Cell z = low.z; z <= high.z; ++z) {
          const auto found = level.cells.find({x, y, z});
          if (found == level.cells.end()) continue;
          for (Entity j : found->second) visit(j);
        }
  }
}

}  // namespace carom
