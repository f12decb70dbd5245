#pragma once
// The numbers of bodies and fixed things.

#include "std.h"

namespace carom {

/// A body or a fixed thing, by number. Bodies have the numbers 0 .. body_count()-1. Planes, walls, obstacles
/// and strings follow.
using Entity = uint32_t;
inline constexpr Entity no_entity = numeric_limits<Entity>::max();

/// Numbers that follow one another.
struct EntityRange {
  Entity first = 0, count = 0;
  bool has(Entity e) const { return e >= first && e - first < count; }
  friend bool operator==(const EntityRange&, const EntityRange&) = default;
};

}  // namespace carom
