// Noise is most of what is left of well predicted numbers. Bits that are stored as they are take no more bytes than
// deflated ones, and a fifth of the time.
//
// A packed block has for each column u32 bytes and u32 packed bytes (0: they are as they are), then u64 bits. Then come
// the columns, each a stream of deflate (RFC 1951) if it is packed, and the bits in words of u64, the first one lowest.
#include "export/flight_columns.h"

#include <isa-l/igzip_lib.h>

#include <cstring>

#include "std.h"

namespace carom {
namespace {

struct ColumnSizes {
  uint32_t bytes[column_count][2];  // of each column, and packed
  uint64_t bits;
};

/// The bits of a finite number, and zero for others, of which processors and programs have several.
uint64_t bits_of_prediction(double predicted) {
  const auto bits = std::bit_cast<uint64_t>(predicted);
  constexpr uint64_t exponent = uint64_t{0x7ff} << 52;
  return (bits & exponent) == exponent ? 0 : bits;
}

constexpr uint64_t sign = uint64_t{1} << 63;

}  // namespace

/// Appends these bytes to `to`, packed if that makes them fewer. Returns how many packed ones there are; 0: none.
uint32_t ColumnWriter::append(span<const uint8_t> bytes, vector<char>& to) {
  const size_t begin = to.size();
  to.resize(begin + bytes.size());
  if (bytes.empty()) return 0;

  auto* const place = reinterpret_cast<uint8_t*>(to.data() + begin);
  const size_t packed = deflation_.pack(bytes, place, bytes.size(), Deflation::Format::plain);
  if (packed > 0 && packed < bytes.size()) {
    to.resize(begin + packed);
    return uint32_t(packed);
  }
  ranges::copy(bytes, to.begin() + ptrdiff_t(begin));
  return 0;
}

/// Seven bits a byte, the lowest first. The highest bit of a byte: there are more.
void ColumnWriter::number(Column column, uint64_t value) {
  for (; value > 127; value >>= 7) byte(column, uint8_t(value | 128));
  byte(column, uint8_t(value));
}

void ColumnWriter::difference(Column column, double predicted, double actual) {
  const uint64_t p = bits_of_prediction(predicted), a = std::bit_cast<uint64_t>(actual);
  if (a == p) return byte(column, 0);
  if (a == 0) return byte(column, DifferenceCode::zero);

  // Positive and negative ones alternate: 0, -1, 1, -2, ...
  const auto difference = int64_t((a & ~sign) - (p & ~sign));
  const uint64_t folded = uint64_t(difference) << 1 ^ uint64_t(difference >> 63);
  const auto length = unsigned(std::bit_width(folded));
  if (length > 63) {
    byte(column, DifferenceCode::all);
    bits(a & 0xffffffff, 32);
    return bits(a >> 32, 32);
  }
  byte(column, uint8_t(length + ((a ^ p) & sign ? DifferenceCode::turned : 0)));
  if (length > 1) bits(folded & ~(uint64_t{1} << (length - 1)), length - 1);
}

/// `count`: up to 63.
inline void ColumnWriter::bits(uint64_t value, unsigned count) {
  word_ |= value << used_;
  used_ += count;
  if (used_ < 64) return;
  words_.push_back(word_);
  used_ -= 64;
  word_ = used_ > 0 ? value >> (count - used_) : 0;
}

size_t ColumnWriter::size() const {
  size_t sum = 8 * words_.size();
  for (const auto& column : columns_) sum += column.size();
  return sum;
}

void ColumnWriter::pack(vector<char>& to) {
  ColumnSizes sizes{};
  sizes.bits = 64 * words_.size() + used_;
  if (used_ > 0) words_.push_back(word_);

  const size_t begin = to.size();
  to.resize(begin + sizeof sizes);
  for (size_t k = 0; k < column_count; ++k) {
    sizes.bytes[k][0] = uint32_t(columns_[k].size());
    sizes.bytes[k][1] = append(columns_[k], to);
    columns_[k].clear();
  }
  std::memcpy(to.data() + begin, &sizes, sizeof sizes);
  const auto* const words = reinterpret_cast<const char*>(words_.data());
  to.insert(to.end(), words, words + 8 * words_.size());

  words_.clear();
  word_ = 0;
  used_ = 0;
}

bool ColumnReader::unpack(span<const char> packed) {
  damaged_ = false;
  ColumnSizes sizes;
  if (packed.size() < sizeof sizes) return false;
  std::memcpy(&sizes, packed.data(), sizeof sizes);
  packed = packed.subspan(sizeof sizes);

  for (size_t k = 0; k < column_count; ++k) {
    const size_t size = sizes.bytes[k][0], stored = sizes.bytes[k][1] > 0 ? sizes.bytes[k][1] : size;
    if (size > largest_column || stored > packed.size()) return false;

    Rest& column = columns_[k];
    column.bytes.resize(size);
    column.at = 0;

    if (sizes.bytes[k][1] == 0) {
      std::copy_n(packed.data(), size, column.bytes.begin());
    } else {
      inflate_state stream;
      isal_inflate_init(&stream);
      stream.next_in = reinterpret_cast<uint8_t*>(const_cast<char*>(packed.data()));
      stream.avail_in = uint32_t(stored);
      stream.next_out = column.bytes.data();
      stream.avail_out = uint32_t(size);
      const bool whole = isal_inflate_stateless(&stream) == ISAL_DECOMP_OK && stream.avail_out == 0;
      if (!whole) return false;
    }
    packed = packed.subspan(stored);
  }

  if (sizes.bits > 8 * packed.size() || packed.size() != (sizes.bits + 63) / 64 * 8) return false;
  bits_.resize(packed.size() + 8);
  if (!packed.empty()) std::memcpy(bits_.data(), packed.data(), packed.size());
  bit_ = 0;
  bit_end_ = sizes.bits;
  return true;
}

bool ColumnReader::at_end() const {
  return !damaged_ && bit_ == bit_end_ &&
         all_of(columns_, [](const Rest& column) { return column.at == column.bytes.size(); });
}

uint8_t ColumnReader::byte(Column column) {
  Rest& rest = columns_[size_t(column)];
  if (rest.at < rest.bytes.size()) return rest.bytes[rest.at++];
  damaged_ = true;
  return 0;
}

uint64_t ColumnReader::number(Column column) {
  uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const uint8_t next = byte(column);
    value |= uint64_t{next & 127u} << shift;
    if (next < 128) return value;
  }
  damaged_ = true;
  return 0;
}

double ColumnReader::difference(Column column, double predicted) {
  const uint64_t p = bits_of_prediction(predicted);
  unsigned length = byte(column);
  if (length == 0) return std::bit_cast<double>(p);
  if (length == DifferenceCode::zero) return 0;
  if (length == DifferenceCode::all) {
    const uint64_t low = bits(32);
    return std::bit_cast<double>(low | bits(32) << 32);
  }
  if (length > DifferenceCode::all) {
    damaged_ = true;
    return 0;
  }

  const uint64_t other_sign = length >= DifferenceCode::turned ? sign : 0;
  length %= DifferenceCode::turned;
  uint64_t folded = 0;
  if (length > 0) folded = length > 1 ? bits(length - 1) | uint64_t{1} << (length - 1) : 1;
  const uint64_t difference = folded >> 1 ^ (0 - (folded & 1));
  return std::bit_cast<double>((((p & ~sign) + difference) & ~sign) | ((p & sign) ^ other_sign));
}

/// `count`: up to 63.
uint64_t ColumnReader::bits(unsigned count) {
  if (bit_end_ - bit_ < count) {
    damaged_ = true;
    return 0;
  }
  const size_t byte = bit_ / 8;
  const unsigned shift = bit_ % 8;
  uint64_t value;
  std::memcpy(&value, &bits_[byte], sizeof value);
  value >>= shift;
  if (shift > 0) value |= uint64_t{bits_[byte + 8]} << (64 - shift);
  bit_ += count;
  return value & ((uint64_t{1} << count) - 1);
}

}  // namespace carom
