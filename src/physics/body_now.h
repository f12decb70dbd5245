#pragma once
// The properties of a body at an instant, since bodies that merge change, and of all bodies.

#include "physics/state.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

/// Whether the body has merged into another body, which represents both, or is out of the world.
inline bool is_gone(const State& state, Entity body) {
  return !state.part_of.empty() && state.part_of[body] != body;
}

/// Whether it is out of the world: it has left it, alone or as a part of another body, or has yet to come.
inline bool is_removed(const State& state, Entity body) {
  return !state.part_of.empty() && state.part_of[body] == no_entity;
}

inline double mass_now(const World& world, const State& state, Entity body) {  // kg
  return state.mass.empty() ? world.mass[body] : state.mass[body];
}

inline double radius_now(const World& world, const State& state, Entity body) {  // m
  return state.radius.empty() ? world.radius[body] : state.radius[body];
}

inline Volume volume_now(const World& world, const State& state, Entity body) {
  if (!state.volume.empty()) return state.volume[body];
  return state.radius.empty() ? world.volume_of(body) : Volume::sphere(state.radius[body]);
}

/// m; 0: there are no bodies.
inline double median_radius(const World& world) {
  vector<double> radii = world.radius;
  if (radii.empty()) return 0;
  const auto middle = radii.begin() + ptrdiff_t(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

}  // namespace carom
