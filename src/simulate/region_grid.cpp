#include "simulate/region_grid.h"

namespace carom {

RegionGrid::RegionGrid(Entity bodies) : slot_(bodies, no_slot), next_(bodies, no_entity), previous_(bodies, no_entity) {
  std::size_t size = 64;
  while (size < 2 * static_cast<std::size_t>(bodies)) size *= 2;
  slots_.resize(size);
  mask_ = size - 1;
}

/// The narrowest width 2^(k/4) that holds a box.
std::uint32_t RegionGrid::level_for(double half) {
  int exponent;
  const double mantissa = std::frexp(2 * half, &exponent);  // in [1/2, 1)
  double width = 1;
  for (double step : {0.8408964152537145, 0.7071067811865476, 0.5946035575013605})
    if (mantissa <= step) width = step;
  width = std::ldexp(width, exponent);
  for (std::uint32_t l = 0; l < levels_.size(); ++l)
    if (levels_[l].width == width) return l;
  levels_.push_back({width});
  return static_cast<std::uint32_t>(levels_.size() - 1);
}

void RegionGrid::link(Entity i, const Key& key) {
  const std::size_t s = find(key);
  Slot& slot = slots_[s];
  if (!slot.used) {
    slot = {key, no_entity, true};
    ++used_;
  }
  slot_[i] = static_cast<std::uint32_t>(s);
  next_[i] = slot.head;
  previous_[i] = no_entity;
  if (slot.head != no_entity) previous_[slot.head] = i;
  slot.head = i;
  ++levels_[key.level].boxes;
}

void RegionGrid::unlink(Entity i) {
  if (slot_[i] == no_slot) return;
  Slot& slot = slots_[slot_[i]];
  if (previous_[i] == no_entity)
    slot.head = next_[i];
  else
    next_[previous_[i]] = next_[i];
  if (next_[i] != no_entity) previous_[next_[i]] = previous_[i];
  --levels_[slot.key.level].boxes;
  slot_[i] = no_slot;
}

/// Drops cells that have emptied; twice the table if most are in use.
void RegionGrid::make_room() {
  std::vector<Slot> old;
  old.swap(slots_);
  std::size_t full = 0;
  for (const Slot& slot : old) full += slot.used && slot.head != no_entity;
  std::size_t size = old.size();
  if (4 * full > size) size *= 2;
  slots_.resize(size);
  mask_ = size - 1;
  used_ = 0;
  for (const Slot& slot : old) {
    if (!slot.used || slot.head == no_entity) continue;
    const std::size_t s = find(slot.key);
    slots_[s] = slot;
    ++used_;
    for (Entity i = slot.head; i != no_entity; i = next_[i]) slot_[i] = static_cast<std::uint32_t>(s);
  }
}

void RegionGrid::put(Entity i, const Vec3& center, double half) {
  const std::uint32_t l = level_for(half);
  const double width = levels_[l].width;
  const Key key{cell_of(center.x(), width), cell_of(center.y(), width), cell_of(center.z(), width), l};
  if (slot_[i] != no_slot && slots_[slot_[i]].key == key) return;
  unlink(i);
  if (2 * (used_ + 1) > slots_.size()) make_room();
  link(i, key);
}

}  // namespace carom
