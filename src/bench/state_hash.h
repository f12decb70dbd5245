#pragma once
// A hash of a result, reported beside its time. Equal hashes mean equal results, bit for bit.
#include <bit>
#include <initializer_list>

#include "physics/state.h"
#include "physics/tally.h"
#include "std.h"

namespace carom {

/// FNV-1a, by words of 64 bits.
inline void add_to_hash(uint64_t& hash, uint64_t word) {
  hash = (hash ^ word) * 0x100000001b3;
}

/// The hash of the bits of all positions and velocities.
inline uint64_t hash_of(const State& state) {
  uint64_t hash = 0xcbf29ce484222325;
  for (const auto* vectors : {&state.position, &state.velocity})
    for (const Vec3& v : *vectors)
      for (double x : v) add_to_hash(hash, std::bit_cast<uint64_t>(x));
  return hash;
}

/// The same with the number of collisions and the times of the first and the last one.
inline uint64_t hash_of(const State& state, const Tally& tally) {
  uint64_t hash = hash_of(state);
  for (const uint64_t count : {tally.body_body, tally.body_fixed, tally.merges, tally.collapses})
    add_to_hash(hash, count);
  for (const double time : {tally.first_collision, tally.last_collision})
    add_to_hash(hash, std::bit_cast<uint64_t>(time));
  return hash;
}

}  // namespace carom
