#pragma once
// Radix sort (Knuth, The Art of Computer Programming 3, 5.2.5) of numbers by floats.
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

namespace carom::raster {

/// The order of these numbers is that of the floats.
inline std::uint32_t key_of(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return bits & 0x80000000U ? ~bits : bits | 0x80000000U;
}

/// Fills `order` with the numbers of the keys in their order. Equals keep theirs.
inline void sort_by_key(const std::vector<std::uint32_t>& keys, std::vector<std::uint32_t>& order,
                        std::vector<std::uint32_t>& spare) {
  order.resize(keys.size());
  spare.resize(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  for (int shift = 0; shift < 32; shift += 11) {
    std::array<std::uint32_t, 2049> places{};
    for (const std::uint32_t key : keys) ++places[(key >> shift & 2047U) + 1];
    std::partial_sum(places.begin(), places.end(), places.begin());
    for (const std::uint32_t i : order) spare[places[keys[i] >> shift & 2047U]++] = i;
    order.swap(spare);
  }
}

}  // namespace carom::raster
