#pragma once
// Prefix codes of limited length, in the canonical order that deflate stores (RFC 1951, 3.2.2).
#include <cstdint>
#include <span>

namespace carom {

/// The bits of a symbol's code, the first one lowest, and their number. 0 bits: the symbol has no code.
struct PrefixCode {
  std::uint16_t bits = 0;
  std::uint8_t size = 0;
};

/// Gives every symbol that occurs a code of at most `longest` bits (up to 15), short where its count is large.
/// A symbol that does not occur has none, except that there are always two codes. All spans are of one size.
void make_prefix_codes(std::span<const std::uint32_t> counts, unsigned longest, std::span<PrefixCode> codes);

}  // namespace carom
