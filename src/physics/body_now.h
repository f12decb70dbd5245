#pragma once
// The properties of a body at an instant. Bodies that merge change.
#include "physics/state.h"
#include "physics/world.h"

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

}  // namespace carom
