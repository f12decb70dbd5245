#pragma once
// The properties of a body at an instant. Bodies that merge change.
#include "files/csv.h"
#include "physics/state.h"
#include "scene/scene.h"

namespace carom {

/// Whether the body has merged into another body, which represents both.
inline bool is_part_of_another(const State& state, Entity body) {
  return !state.part_of.empty() && state.part_of[body] != body;
}

inline double mass_now(const World& world, const State& state, Entity body) {  // kg
  return state.mass.empty() ? world.mass[body] : state.mass[body];
}

inline Volume volume_now(const World& world, const State& state, Entity body) {
  if (!state.volume.empty()) return state.volume[body];
  return state.radius.empty() ? world.volume_of(body) : Volume::sphere(state.radius[body]);
}

/// Whether the world has boxes or cylinders.
inline bool has_solids(const World& world) {
  for (const Volume& volume : world.volume)
    if (volume.shape != Shape::sphere) return true;
  return false;
}

/// The maximum number of characters after the group's name in a member's name: a dot and the member's number.
inline constexpr std::size_t member_size = 1 + number_size;

/// Writes a body's name and returns its end. Names are [A-Za-z_][A-Za-z0-9_-]* and need no quotes in a cell.
inline char* put_member(char* to, const BodyRange& range, Entity body) {
  to = put_text(to, range.name);
  if (!range.group) return to;
  *to++ = '.';
  return put_number(to, std::uint64_t{body - range.first});
}

}  // namespace carom
