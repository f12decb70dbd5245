#pragma once
// A result in one number, which stands beside its time: the same number is the same result, bit for bit.
#include <bit>
#include <cstdint>
#include <initializer_list>

#include "physics/state.h"
#include "physics/tally.h"

namespace carom {

/// FNV-1a, by words of 64 bits.
inline void add_to_hash(std::uint64_t& hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3;
}

/// Over the bits of all positions and velocities.
inline std::uint64_t hash_of(const State& state) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const Vec3& v : *vectors)
      for (double x : v) add_to_hash(hash, std::bit_cast<std::uint64_t>(x));
  return hash;
}

/// Over these, and over how many collisions there were, and when the first and the last one.
inline std::uint64_t hash_of(const State& state, const Tally& tally) {
  std::uint64_t hash = hash_of(state);
  for (const std::uint64_t count : {tally.body_body, tally.body_fixed, tally.merges, tally.collapses})
    add_to_hash(hash, count);
  for (const double time : {tally.first_collision, tally.last_collision})
    add_to_hash(hash, std::bit_cast<std::uint64_t>(time));
  return hash;
}

}  // namespace carom
