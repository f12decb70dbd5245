#pragma once
// A block of deflate (RFC 1951): literals and matches are collected, then written with codes of their own.
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace carom {

struct PrefixCode;

/// Bits, the lowest of a byte first, in a memory with room for 8 bytes more than are written.
struct BitWriter {
  std::uint8_t* end = nullptr;  // of the whole bytes
  std::uint64_t pending = 0;    // the bits after them
  unsigned count = 0;           // of these, at most 7

  /// Adds up to 57 bits.
  void put(std::uint64_t bits, unsigned size) {
    pending |= bits << count;
    count += size;
    std::memcpy(end, &pending, 8);
    end += count / 8;
    pending >>= count & ~7U;
    count &= 7;
  }
};

class DeflateBlock {
 public:
  static constexpr std::size_t least_match = 3, most_match = 258, window = 32768;  // bytes

  DeflateBlock();

  /// Whether there is no room for 8 literals more.
  bool is_full() const { return count_ + 8 > tokens_.size(); }
  void add_literals(const std::uint8_t* bytes, std::size_t count) {
    std::uint32_t* const to = tokens_.data() + count_;
    for (std::size_t i = 0; i < count; ++i) {
      to[i] = bytes[i] | no_distance << distance_at;
      ++symbols_[bytes[i]];
    }
    count_ += count;
  }
  /// `length`: from least_match to most_match. `distance`: from 1 to window, back.
  void add_match(std::size_t length, std::size_t distance);
  /// Appends the block to `out` and begins the next one. The last one of a stream fills its last byte with zeros.
  void write(bool last, std::string& out);

 private:
  // A token, from its lowest bit: a byte, or length_offset + the length; the distance's symbol; the rest of the
  // distance.
  static constexpr std::uint32_t length_offset = 253;  // follows the bytes: lengths begin at 3
  static constexpr unsigned distance_at = 10, rest_at = 15;
  static constexpr std::uint32_t no_distance = 30;  // of a literal

  void write_tokens(std::span<const PrefixCode> codes, std::span<const PrefixCode> distance_codes);

  std::vector<std::uint32_t> tokens_;
  std::size_t count_ = 0;  // of tokens
  /// How often each byte and each length occurs, and each symbol of a distance.
  std::array<std::uint32_t, 512> symbols_{};
  std::array<std::uint32_t, 32> distances_{};
  std::vector<std::uint8_t> bytes_;
  BitWriter bits_;  // in bytes_
};

}  // namespace carom
