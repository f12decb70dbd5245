#pragma once
// The frame of flights.bin (flights_file.h): its sizes, and what both of its sides have in common.
#include <isa-l/crc.h>

#include <bit>

#include "std.h"

namespace carom::flights_format {

static_assert(std::endian::native == std::endian::little);

inline constexpr string_view magic = "caromfly";
inline constexpr uint32_t version = 8;
inline constexpr uint32_t byte_order = 0x01020304;
inline constexpr uint32_t last_entry = 0xffffffff;
inline constexpr uint64_t collisions_bit = uint64_t{1} << 63;
inline constexpr uint64_t impulses_bit = uint64_t{1} << 62;

// Bytes.
inline constexpr size_t header_size = 32;
inline constexpr size_t block_head = 24;
inline constexpr size_t checksum_place = 12;  // in the head of a block
inline constexpr size_t key_size = 24;
inline constexpr size_t end_size = 12 * 8;
inline constexpr size_t tail_size = 8 + 26 * 8;

enum BlockKind : uint32_t { of_entries = 0, of_key = 1, more_of_key = 2 };

/// Of a block with its head, which has zero in the checksum's place.
inline uint32_t checksum_of(span<const char> block) {
  return crc32_gzip_refl(0, reinterpret_cast<const uint8_t*>(block.data()), block.size());
}

/// The counts of the tail, in its order.
template <typename Sums>
auto counts_of(Sums& tally) {
  return array{&tally.body_body,          &tally.body_fixed,      &tally.merges,
               &tally.tautened,           &tally.collapses,       &tally.resting,
               &tally.taken_up.impacts,   &tally.shared.instants, &tally.shared.ties,
               &tally.shared.without_room};
}

/// The values of the tail, in its order.
template <typename Sums>
auto values_of(Sums& tally) {
  return array{&tally.first_collision, &tally.last_collision, &tally.energy_lost,     &tally.work,
               &tally.max_overlap,     &tally.fastest.speed,  &tally.stepped_contact, &tally.taken_up.fastest,
               &tally.taken_up.energy, &tally.shared.first,   &tally.shared.absorbed};
}

}  // namespace carom::flights_format
