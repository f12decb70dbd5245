// CRC-32 takes 8 bytes at a time from 8 tables. Adler-32 runs in 16 columns, which compilers turn into vectors.
// Both are integers, so that every machine has the same sums.
#include "export/checksums.h"

#include <algorithm>
#include <array>

namespace carom {
namespace {

/// tables[k][b]: the CRC of byte b followed by k zero bytes.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr CrcTables crc_tables = [] {
  CrcTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320U : 0);
    tables[0][byte] = crc;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::uint32_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = tables[k - 1][byte] >> 8 ^ tables[0][tables[k - 1][byte] & 255];
  return tables;
}();

constexpr std::uint32_t adler_modulus = 65521;
constexpr std::size_t columns = 16;
/// Rows of bytes after which the sums of a column could exceed 32 bits: 255 n^2 / 2.
constexpr std::size_t most_rows = 4096;

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before) {
  const CrcTables& t = crc_tables;
  std::uint32_t crc = ~before;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    const std::uint8_t* b = bytes.data() + i;
    crc = t[7][b[0] ^ (crc & 255)] ^ t[6][b[1] ^ (crc >> 8 & 255)] ^ t[5][b[2] ^ (crc >> 16 & 255)] ^
          t[4][b[3] ^ crc >> 24] ^ t[3][b[4]] ^ t[2][b[5]] ^ t[1][b[6]] ^ t[0][b[7]];
  }
  for (; i < bytes.size(); ++i) crc = t[0][(crc ^ bytes[i]) & 255] ^ crc >> 8;
  return ~crc;
}

// a = 1 + sum of x_i, b = sum of the a after each byte, both modulo 65521.
// Column j has sum[j] = sum of its bytes, and total[j] = sum of its sums before each row.
// A byte of column j in row r of n counts columns * (n - 1 - r) + columns - j times in b.
std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
  std::uint64_t a = 1, b = 0;
  while (bytes.size() >= columns) {
    const std::size_t rows = std::min(bytes.size() / columns, most_rows);
    std::uint32_t sum[columns] = {}, total[columns] = {};
    const std::uint8_t* row = bytes.data();
    for (std::size_t r = 0; r < rows; ++r, row += columns)
      for (std::size_t j = 0; j < columns; ++j) {
        total[j] += sum[j];
        sum[j] += row[j];
      }
    b += a * (rows * columns);
    for (std::size_t j = 0; j < columns; ++j) {
      a += sum[j];
      b += std::uint64_t{columns} * total[j] + (columns - j) * std::uint64_t{sum[j]};
    }
    a %= adler_modulus;
    b %= adler_modulus;
    bytes = bytes.subspan(rows * columns);
  }
  for (const std::uint8_t byte : bytes) {
    a += byte;
    b += a;
  }
  return static_cast<std::uint32_t>(b % adler_modulus << 16 | a % adler_modulus);
}

}  // namespace carom
