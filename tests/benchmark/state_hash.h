#pragma once
// Beside a time stands a hash of the final state: the same number is the same result, bit for bit.
#include <bit>
#include <cstdint>

#include "physics/state.h"

namespace carom {

/// FNV-1a over the bits of all positions and velocities.
inline std::uint64_t hash_of(const State& state) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const Vec3& v : *vectors)
      for (double x : v) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
  return hash;
}

}  // namespace carom
