#pragma once
// Boxes in unbounded space, found by place. Every box is kept in one cell, that of its centre, on the level whose cells
// are just as wide as the box or a little wider: levels are quarter octaves, so boxes of all sizes live together. Cells
// are hashed; empty space costs nothing. The order in which boxes are visited is the table's own: results must not
// depend on it.
#include <cmath>
#include <cstdint>
#include <vector>

#include "physics/vec3.h"
#include "physics/world.h"

namespace carom {

class RegionGrid {
 public:
  explicit RegionGrid(Entity bodies);

  /// Puts body i's box (centre, half width, m) in, or moves it.
  void put(Entity i, const Vec3& center, double half);

  /// Takes body i's box out.
  void remove(Entity i) { unlink(i); }

  /// Calls visit(j) for every body whose box may overlap the given one (all that do, and some that do not).
  template <typename Visit>
  void near(const Vec3& center, double half, Visit visit) const;

 private:
  using Cell = std::int64_t;
  struct Key {
    Cell x, y, z;
    std::uint32_t level;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Slot {
    Key key;
    Entity head = no_entity;  // of the list of boxes in this cell
    bool used = false;        // a cell stays in the table when its last box leaves, until the table is made anew
  };
  struct Level {
    double width;           // m, of a cell: the widest box that it holds
    std::size_t boxes = 0;  // on this level now
  };

  static std::size_t hash(const Key& k) {
    const auto mix = [](std::uint64_t h, std::uint64_t c) {
      h = (h ^ c) * 0x9E3779B97F4A7C15ull;
      return h ^ (h >> 29);
    };
    const auto bits = [](Cell c) { return static_cast<std::uint64_t>(c); };
    return mix(mix(mix(k.level, bits(k.x)), bits(k.y)), bits(k.z));
  }
  // Far beyond 2^60 cells everything shares the outermost cell: slower there, never wrong.
  static Cell cell_of(double x, double width) {
    const double c = std::floor(x / width);
    return c < -0x1p60 ? -(Cell{1} << 60) : c > 0x1p60 ? Cell{1} << 60 : static_cast<Cell>(c);
  }
  std::size_t find(const Key& key) const {  // its slot, or the free one where it belongs
    std::size_t s = hash(key) & mask_;
    while (slots_[s].used && !(slots_[s].key == key)) s = (s + 1) & mask_;
    return s;
  }
  std::uint32_t level_for(double half);
  void link(Entity i, const Key& key);
  void unlink(Entity i);
  void make_room();

  std::vector<Level> levels_;
  std::vector<Slot> slots_;
  std::size_t mask_, used_ = 0;
  std::vector<std::uint32_t> slot_;      // by body; no_slot: not in
  std::vector<Entity> next_, previous_;  // by body, within its cell
  static constexpr std::uint32_t no_slot = ~std::uint32_t{0};
};

template <typename Visit>
void RegionGrid::near(const Vec3& center, double half, Visit visit) const {
  for (std::uint32_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    if (level.boxes == 0) continue;
    const double reach = half + 0.5 * level.width;
    const Vec3 from = center - Vec3::Constant(reach), to = center + Vec3::Constant(reach);
    const Key low{cell_of(from.x(), level.width), cell_of(from.y(), level.width), cell_of(from.z(), level.width), l};
    const Key high{cell_of(to.x(), level.width), cell_of(to.y(), level.width), cell_of(to.z(), level.width), l};
    const auto visit_list = [&](Entity head) {
      for (Entity j = head; j != no_entity;) {
        const Entity after = next_[j];
        visit(j);
        j = after;
      }
    };
    const double cells = (static_cast<double>(high.x - low.x) + 1) * (static_cast<double>(high.y - low.y) + 1) *
                         (static_cast<double>(high.z - low.z) + 1);
    if (cells > static_cast<double>(slots_.size())) {  // wider than what there is: look at what there is
      for (const Slot& slot : slots_)
        if (slot.used && slot.key.level == l) visit_list(slot.head);
      continue;
    }
    for (Key key = low; key.x <= high.x; ++key.x)
      for (key.y = low.y; key.y <= high.y; ++key.y)
        for (key.z = low.z; key.z <= high.z; ++key.z) {
          const Slot& slot = slots_[find(key)];
          if (slot.used) visit_list(slot.head);
        }
  }
}

}  // namespace carom
