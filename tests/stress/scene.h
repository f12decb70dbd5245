#pragma once
// A random scene, determined by its seed on every machine (but not by every compiler: the order of evaluating arguments
// differs).

#include "physics/state.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "std.h"

namespace carom::stress {

struct RandomScene {
  uint64_t seed = 0;
  string family;
  World world;
  State initial;
  ExactOptions options;
  // Its physics may have more collisions than max_collisions, or speeds without bound: such an error is correct.
  bool may_stop = false;
};

span<const char* const> family_names();

/// The seed modulo the number of families chooses one. `bytes`: the source of its numbers while they last.
RandomScene make_scene(uint64_t seed, string_view bytes = {});

/// The same scene with fixed things that move.
RandomScene with_motions(RandomScene scene);

/// The scene as a file that `carom run` reads, to the last bit. `simulate`: more keys (", engine: book").
string as_yaml(const RandomScene& scene, const string& simulate = {});

/// Forces of random scenes are uniform.
inline bool per_mass(const Force& f) {
  return std::holds_alternative<UniformAcceleration>(f.law);
}
inline const Vec3& value(const Force& f) {  // m/s^2 or N
  return per_mass(f) ? std::get<UniformAcceleration>(f.law).value : std::get<UniformForce>(f.law).force;
}
inline Vec3& value(Force& f) {
  return per_mass(f) ? std::get<UniformAcceleration>(f.law).value : std::get<UniformForce>(f.law).force;
}

}  // namespace carom::stress
