#pragma once
// Random small scenes of everything at once: all volumes, surfaces, forces, engines, and odd numbers, within bounds
// where rounding does not dominate.

#include "std.h"
#include "stress/scene.h"

namespace carom::fuzz {

// A scene has its own units. In them its lengths, times and masses are between a thousandth and some thousands.
inline constexpr double smallest_length = 1e-3, largest_length = 1e3;  // m
inline constexpr double shortest_time = 1e-3, longest_time = 2;        // s
inline constexpr double lightest = 1e-9, heaviest = 1e9;               // kg
inline constexpr double most_lengths = 1e3, most_speeds = 1e2;         // of the unit: places reach 1e6 m
inline constexpr int most_steps = 2000;
inline constexpr double longest_in_default_steps = 20;  // s: they take a millisecond at most

struct AnyScene {
  stress::RandomScene scene;
  string simulate;  // keys beside those of scene.options: ", engine: stepped, step: 0.01"
  string engine;    // as those say

  string yaml() const { return stress::as_yaml(scene, simulate); }
};

/// A scene of one of the families of random scenes, or one of everything at once. It is made of the bytes while they
/// last, then of the seed.
AnyScene make_any_scene(uint64_t seed, string_view bytes = {});

}  // namespace carom::fuzz
