#pragma once
// A block of flights.bin: columns of bytes, and the bits of numbers that differ from their prediction.
//
// A difference is that of the two numbers as integers, of their bits without the sign. One byte has its length in bits,
// and the bits after its first one go to a column of their own, which has no bytes to save. All other columns are
// deflated.
#include <bit>

#include "files/deflation.h"
#include "std.h"

namespace carom {

/// What a byte of a column belongs to.
enum class Column : uint8_t { shape, body, time, place, velocity, acceleration, kick, curve, other };
inline constexpr size_t column_count = 9;

/// How a number differs from its prediction. Differences 0, -1, 1, -2 ... are 0, 1, 2, 3 ..., whose length in bits is
/// the code, up to 63. With `turned` more, the sign is another one, too.
struct DifferenceCode {
  static constexpr uint8_t turned = 64;
  static constexpr uint8_t zero = 128;  // the number is +0
  static constexpr uint8_t all = 129;   // the number itself, in 64 bits
};

/// Columns that are filled.
class ColumnWriter {
 public:
  static constexpr bool writes = true;

  void byte(Column column, uint8_t value) { of(column).push_back(value); }
  void number(Column column, uint64_t value);
  /// What a reader needs to know `actual`, if it knows `predicted`.
  void difference(Column column, double predicted, double actual);

  size_t size() const;  // in bytes, before they are packed
  void keep(auto& archive) { archive(columns_, words_, word_, used_); }
  /// Appends the packed columns to `to`, and empties them.
  void pack(vector<char>& to);

 private:
  vector<uint8_t>& of(Column column) { return columns_[size_t(column)]; }
  void bits(uint64_t value, unsigned count);
  uint32_t append(span<const uint8_t> bytes, vector<char>& to);

  array<vector<uint8_t>, column_count> columns_;
  vector<uint64_t> words_;  // of bits, the first one lowest
  uint64_t word_ = 0;       // the last one, of which `used_` bits are there
  unsigned used_ = 0;
  Deflation deflation_;
};

/// Columns that are read. What is not there reads as zeros, and damaged() from then on.
class ColumnReader {
 public:
  static constexpr bool writes = false;

  /// Takes the columns that `packed` has. False: it is damaged.
  bool unpack(span<const char> packed);

  uint8_t byte(Column column);
  uint64_t number(Column column);
  double difference(Column column, double predicted);
  bool damaged() const { return damaged_; }
  /// Whether all is read.
  bool at_end() const;

 private:
  uint64_t bits(unsigned count);

  struct Rest {
    vector<uint8_t> bytes;
    size_t at = 0;
  };
  array<Rest, column_count> columns_;
  vector<uint8_t> bits_;  // eight more than there are, for reads of whole words
  size_t bit_ = 0, bit_end_ = 0;
  bool damaged_ = false;
};

/// The most bytes of a column, so that a damaged block takes no more memory.
inline constexpr size_t largest_column = size_t{1} << 20;

}  // namespace carom
