#pragma once
// The checksums of PNG: CRC-32 of its chunks, Adler-32 of its pixels.
#include <cstdint>
#include <span>

namespace carom {

/// CRC-32 as in PNG (ISO/IEC 15948, 5.5). `before`: that of the bytes before these.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0);

/// Adler-32 (RFC 1950).
std::uint32_t adler32(std::span<const std::uint8_t> bytes);

}  // namespace carom
