#pragma once
// The properties of a body at an instant, and its name in a table.
#include "files/csv.h"
#include "physics/body_now.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// Whether the world has boxes or cylinders.
inline bool has_solids(const World& world) {
  for (const Volume& volume : world.volume)
    if (volume.shape != Shape::sphere) return true;
  return false;
}

/// The maximum number of characters after the group's name in a member's name: a dot and the member's number.
inline constexpr size_t member_size = 1 + number_size;

/// Writes a body's name and returns its end. Names are [A-Za-z_][A-Za-z0-9_-]* and need no quotes in a cell.
inline char* put_member(char* to, const BodyRange& range, Entity body) {
  to = put_text(to, range.name);
  if (!range.group) return to;
  *to++ = '.';
  return put_number(to, uint64_t{body - range.first});
}

}  // namespace carom
