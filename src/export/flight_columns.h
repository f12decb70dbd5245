#pragma once
// A block of flights.bin: columns of bytes, and the bits of numbers that differ from their prediction.
//
// A difference is that of the two numbers as integers, of their bits without the sign. One byte has its length in bits,
// and the bits after its first one go to a column of their own, which has no bytes to save. All other columns are
// deflated.
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "export/deflation.h"

namespace carom {

/// What a byte of a column belongs to.
enum class Column : std::uint8_t { shape, body, time, place, velocity, acceleration, kick, curve, other };
inline constexpr std::size_t column_count = 9;

/// How a number differs from its prediction. Differences 0, -1, 1, -2 ... are 0, 1, 2, 3 ..., whose length in bits is
/// the code, up to 63. With `turned` more, the sign is another one, too.
struct DifferenceCode {
  static constexpr std::uint8_t turned = 64;
  static constexpr std::uint8_t zero = 128;  // the number is +0
  static constexpr std::uint8_t all = 129;   // the number itself, in 64 bits
};

/// Columns that are filled.
class ColumnWriter {
 public:
  static constexpr bool writes = true;

  void byte(Column column, std::uint8_t value) { of(column).push_back(value); }
  void number(Column column, std::uint64_t value);
  /// What a reader needs to know `actual`, if it knows `predicted`.
  void difference(Column column, double predicted, double actual);

  std::size_t size() const;  // in bytes, before they are packed
  void keep(auto& archive) { archive(columns_, words_, word_, used_); }
  /// Appends the packed columns to `to`, and empties them.
  void pack(std::vector<char>& to);

 private:
  std::vector<std::uint8_t>& of(Column column) { return columns_[static_cast<std::size_t>(column)]; }
  void bits(std::uint64_t value, unsigned count);
  std::uint32_t append(std::span<const std::uint8_t> bytes, std::vector<char>& to);

  std::array<std::vector<std::uint8_t>, column_count> columns_;
  std::vector<std::uint64_t> words_;  // of bits, the first one lowest
  std::uint64_t word_ = 0;            // the last one, of which `used_` bits are there
  unsigned used_ = 0;
  Deflation deflation_;
};

/// Columns that are read. What is not there reads as zeros, and damaged() from then on.
class ColumnReader {
 public:
  static constexpr bool writes = false;

  /// Takes the columns that `packed` has. False: it is damaged.
  bool unpack(std::span<const char> packed);

  std::uint8_t byte(Column column);
  std::uint64_t number(Column column);
  double difference(Column column, double predicted);
  bool damaged() const { return damaged_; }
  /// Whether all is read.
  bool at_end() const;

 private:
  std::uint64_t bits(unsigned count);

  struct Rest {
    std::vector<std::uint8_t> bytes;
    std::size_t at = 0;
  };
  std::array<Rest, column_count> columns_;
  std::vector<std::uint8_t> bits_;  // eight more than there are, for reads of whole words
  std::size_t bit_ = 0, bit_end_ = 0;
  bool damaged_ = false;
};

/// The most bytes of a column, so that a damaged block takes no more memory.
inline constexpr std::size_t largest_column = std::size_t{1} << 20;

}  // namespace carom
