#include "simulate/region_grid.h"

namespace carom {

int RegionGrid::level_for(double half) {
  int exponent;
  std::frexp(2 * half, &exponent);  // 2 half <= 2^exponent
  for (std::size_t k = 0; k < levels_.size(); ++k)
    if (levels_[k].exponent == exponent) return static_cast<int>(k);
  levels_.push_back({exponent, std::ldexp(1.0, exponent), 0, {}});
  return static_cast<int>(levels_.size() - 1);
}

void RegionGrid::take_out(Entity i) {
  Place& place = place_[i];
  if (place.level == no_level) return;
  Level& level = levels_[static_cast<std::size_t>(place.level)];
  const auto found = level.cells.find(place.cell);
  std::vector<Entity>& boxes = found->second;
  const Entity last = boxes.back();
  boxes[place.slot] = last;
  place_[last].slot = place.slot;
  boxes.pop_back();
  if (boxes.empty()) level.cells.erase(found);
  --level.boxes;
  place.level = no_level;
}

void RegionGrid::put(Entity i, const Vec3& center, double half) {
  const int to = level_for(half);
  const double width = levels_[static_cast<std::size_t>(to)].width;
  const Key cell{cell_of(center.x(), width), cell_of(center.y(), width), cell_of(center.z(), width)};
  Place& place = place_[i];
  if (place.level == to && place.cell == cell) return;
  take_out(i);
  Level& level = levels_[static_cast<std::size_t>(to)];
  std::vector<Entity>& boxes = level.cells[cell];
  place = {to, cell, static_cast<std::uint32_t>(boxes.size())};
  boxes.push_back(i);
  ++level.boxes;
}

}  // namespace carom
