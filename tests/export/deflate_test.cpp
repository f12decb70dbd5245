// The compression of pictures, read back by zlib.
#include "export/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "export/checksums.h"
#include "export/huffman.h"

namespace carom {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string compressed(const Bytes& bytes, std::size_t pixel = 3) {
  std::string out;
  Deflater().compress(bytes, pixel, out);
  return out;
}

/// What zlib makes of a stream. Empty: it is damaged, or has another length.
Bytes inflated(const std::string& stream, std::size_t size) {
  Bytes bytes(size + 1);  // zlib wants room, even for nothing
  uLongf length = bytes.size();
  if (uncompress(bytes.data(), &length, reinterpret_cast<const Bytef*>(stream.data()), stream.size()) != Z_OK)
    return {};
  bytes.resize(length);
  return bytes;
}

Bytes noise(std::size_t size, unsigned values) {
  std::mt19937 random(7);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % values);
  return bytes;
}

/// Noise that begins again after `period` bytes.
Bytes repeated(std::size_t size, std::size_t period) {
  Bytes bytes = noise(size, 256);
  for (std::size_t i = period; i < size; ++i) bytes[i] = bytes[i - period];
  return bytes;
}

TEST(Deflate, ReadsBackByteForByte) {
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 263U, 5000U, 32'768U, 300'000U})
    for (const unsigned values : {1U, 2U, 3U, 17U, 256U})
      for (const std::size_t pixel : {3U, 4U}) {
        const Bytes bytes = noise(size, values);
        EXPECT_TRUE(inflated(compressed(bytes, pixel), size) == bytes) << size << ", " << values << ", " << pixel;
      }
}

TEST(Deflate, FindsMatchesOfEveryLength) {
  for (const std::size_t period : {1U, 2U, 3U, 5U, 8U, 100U, 257U, 258U, 259U}) {
    const Bytes bytes = repeated(100'000, period);
    const std::string stream = compressed(bytes);
    EXPECT_TRUE(inflated(stream, bytes.size()) == bytes) << period;
    EXPECT_LT(stream.size(), 2000U) << period;
  }
  for (std::size_t length = 1; length <= 300; ++length) {
    Bytes bytes = noise(2000, 256);
    std::copy_n(bytes.begin() + 102, length, bytes.begin() + 1500);
    EXPECT_TRUE(inflated(compressed(bytes), bytes.size()) == bytes) << length;
  }
}

TEST(Deflate, FindsMatchesUpToTheEndOfTheWindowAndNoneBeyond) {
  const Bytes mark = noise(200, 256);
  const auto size_with_mark_after = [&](std::size_t distance) {
    Bytes bytes(distance + mark.size());
    std::copy(mark.begin(), mark.end(), bytes.begin());
    std::copy(mark.begin(), mark.end(), bytes.end() - static_cast<std::ptrdiff_t>(mark.size()));
    const std::string stream = compressed(bytes);
    EXPECT_TRUE(inflated(stream, bytes.size()) == bytes) << distance;
    return stream.size();
  };
  for (const std::size_t distance : {1000U, 4096U, 24'577U, 32'767U, 32'768U})
    EXPECT_LT(size_with_mark_after(distance), 500U) << distance;
  EXPECT_GT(size_with_mark_after(32'769), 600U);
}

TEST(Deflate, WhatCannotBeCompressedGrowsByLittle) {
  const Bytes bytes = noise(1'000'000, 256);
  EXPECT_LT(compressed(bytes).size(), bytes.size() * 1.005);
}

TEST(Deflate, ADeflaterUsedAgainGivesTheSameBytes) {
  Deflater deflater;
  const Bytes a = noise(200'000, 5), b = noise(1000, 256);
  for (const Bytes* bytes : {&a, &b, &a}) {
    std::string out;
    deflater.compress(*bytes, 3, out);
    EXPECT_EQ(out, compressed(*bytes));
  }
}

TEST(Deflate, ItsBytesAreTheSameOnEveryMachine) {
  EXPECT_EQ(crc32(bytes_of(compressed(noise(200'000, 5)))), 3803579666U);
  EXPECT_EQ(crc32(bytes_of(compressed(repeated(200'000, 1000), 4))), 2456574149U);
}

TEST(PrefixCodes, NoneIsLongerThanAllowedAndAllTogetherAreComplete) {
  // Counts of Fibonacci make the deepest tree: 30 symbols would take 29 bits.
  std::vector<std::uint32_t> counts = {1, 1};
  while (counts.size() < 30) counts.push_back(counts[counts.size() - 1] + counts[counts.size() - 2]);
  for (const unsigned longest : {5U, 7U, 9U, 15U}) {
    std::vector<PrefixCode> codes(counts.size());
    make_prefix_codes(counts, longest, codes);
    double sum = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      EXPECT_GE(codes[i].size, 1);
      EXPECT_LE(codes[i].size, longest);
      EXPECT_LE(codes[i].size, codes[i > 0 ? i - 1 : 0].size) << "a frequent symbol has a longer code";
      sum += std::ldexp(1, -codes[i].size);
    }
    EXPECT_EQ(sum, 1) << longest;
  }
}

TEST(PrefixCodes, HaveTheSizesOfHuffmansTree) {
  // By hand: 1 + 1 = 2, 2 + 2 = 4, 4 + 5 = 9, 9 + 10 = 19.
  const std::vector<std::uint32_t> counts = {10, 1, 0, 1, 5, 2};
  std::vector<PrefixCode> codes(counts.size());
  make_prefix_codes(counts, 15, codes);
  std::vector<int> sizes;
  for (const PrefixCode& code : codes) sizes.push_back(code.size);
  EXPECT_EQ(sizes, (std::vector<int>{1, 4, 0, 4, 2, 3}));
  // Canonical: 0, 10, 110, 1110, 1111, the first bit lowest.
  EXPECT_EQ(codes[0].bits, 0b0);
  EXPECT_EQ(codes[4].bits, 0b01);
  EXPECT_EQ(codes[5].bits, 0b011);
  EXPECT_EQ(codes[1].bits, 0b0111);
  EXPECT_EQ(codes[3].bits, 0b1111);
}

TEST(PrefixCodes, AreAtLeastTwo) {
  for (const std::vector<std::uint32_t>& counts : {std::vector<std::uint32_t>{0, 0, 0}, {0, 7, 0}, {7, 0, 0}}) {
    std::vector<PrefixCode> codes(counts.size());
    make_prefix_codes(counts, 15, codes);
    int with_code = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      with_code += codes[i].size == 1;
      EXPECT_TRUE(counts[i] == 0 || codes[i].size == 1);
    }
    EXPECT_EQ(with_code, 2);
  }
}

TEST(Checksums, AreThoseOfZlib) {
  for (const std::size_t size : {0U, 1U, 7U, 8U, 15U, 16U, 17U, 1000U, 65'536U, 65'537U, 500'000U})
    for (const unsigned values : {1U, 256U}) {
      Bytes bytes = noise(size, values);
      if (values == 1) std::fill(bytes.begin(), bytes.end(), std::uint8_t{255});  // the largest sums
      const auto length = static_cast<uInt>(size);
      EXPECT_EQ(crc32(bytes), ::crc32(0, bytes.data(), length)) << size;
      EXPECT_EQ(adler32(bytes), ::adler32(1, bytes.data(), length)) << size;
      const std::span<const std::uint8_t> all(bytes);
      EXPECT_EQ(crc32(all.subspan(size / 3), crc32(all.first(size / 3))), crc32(bytes)) << size;
    }
}

}  // namespace
}  // namespace carom
