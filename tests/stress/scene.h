#pragma once
// A random scene: made from its seed alone, the same on every machine.
#include <cstdint>
#include <span>
#include <string>

#include "physics/state.h"
#include "physics/world.h"
#include "simulate/exact.h"

namespace carom::stress {

struct RandomScene {
  std::uint64_t seed = 0;
  std::string family;
  World world;
  State initial;
  ExactOptions options;
  // Its physics may have more collisions than max_collisions, or speeds without bound: such an error is right.
  bool may_stop = false;
};

std::span<const char* const> family_names();

RandomScene make_scene(std::uint64_t seed);

/// The scene as a file that `carom run` reads, to the last bit.
std::string as_yaml(const RandomScene& scene);

}  // namespace carom::stress
