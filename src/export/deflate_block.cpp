// A token has 32 bits, and a literal is one with a distance of no bits. Literals and matches are thus written by the
// same instructions, without a branch that a processor could predict wrongly.
#include "export/deflate_block.h"

#include <algorithm>
#include <bit>

#include "export/huffman.h"

namespace carom {
namespace {

constexpr std::size_t tokens_in_block = 32768;

// Symbols: 0 to 255 are bytes, 256 ends a block, 257 to 285 are lengths.
constexpr std::size_t end_of_block = 256, first_length = 257, most_symbols = 286, most_distances = 30;
constexpr std::size_t most_code_sizes = 19;

struct LengthSymbol {
  std::uint16_t base;  // the shortest length
  std::uint8_t extra;  // bits
};
constexpr std::array<LengthSymbol, most_symbols - first_length> length_symbols = {
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};

/// The entry of length_symbols for each length.
constexpr std::array<std::uint8_t, DeflateBlock::most_match + 1> symbol_of_length = [] {
  std::array<std::uint8_t, DeflateBlock::most_match + 1> symbols{};
  for (std::size_t length = DeflateBlock::least_match, symbol = 0; length < symbols.size(); ++length) {
    if (symbol + 1 < length_symbols.size() && length >= length_symbols[symbol + 1].base) ++symbol;
    symbols[length] = static_cast<std::uint8_t>(symbol);
  }
  return symbols;
}();

/// `d`: the distance - 1.
unsigned distance_symbol(std::uint32_t d) {
  if (d < 2) return d;
  const unsigned top = static_cast<unsigned>(std::bit_width(d)) - 1;
  return 2 * top + (d >> (top - 1) & 1);
}

constexpr unsigned distance_extra(std::size_t symbol) {
  return symbol < 4 ? 0 : static_cast<unsigned>(symbol / 2 - 1);
}

/// A step of a block's header: the size of a code, or a repetition with its extra bits.
struct HeaderStep {
  std::uint8_t symbol, extra, extra_bits;
};

HeaderStep step_of(std::size_t symbol, std::size_t extra, std::size_t extra_bits) {
  return {static_cast<std::uint8_t>(symbol), static_cast<std::uint8_t>(extra), static_cast<std::uint8_t>(extra_bits)};
}

/// 3.2.7: symbol 16 repeats the size before it 3 to 6 times, 17 is 3 to 10 zeros, 18 is 11 to 138 of them.
std::vector<HeaderStep> header_steps(std::span<const std::uint8_t> sizes) {
  std::vector<HeaderStep> steps;
  for (std::size_t i = 0; i < sizes.size();) {
    std::size_t run = 1;
    while (i + run < sizes.size() && sizes[i + run] == sizes[i]) ++run;
    if (sizes[i] == 0 && run >= 3) {
      run = std::min<std::size_t>(run, 138);
      steps.push_back(run <= 10 ? step_of(17, run - 3, 3) : step_of(18, run - 11, 7));
    } else if (i > 0 && sizes[i] == sizes[i - 1] && run >= 3) {
      run = std::min<std::size_t>(run, 6);
      steps.push_back(step_of(16, run - 3, 2));
    } else {
      run = 1;
      steps.push_back(step_of(sizes[i], 0, 0));
    }
    i += run;
  }
  return steps;
}

/// The sizes of the codes, up to the last one that is not 0, but at least `least` of them.
std::size_t append_sizes(std::span<const PrefixCode> codes, std::size_t least, std::vector<std::uint8_t>& sizes) {
  std::size_t count = codes.size();
  while (count > least && codes[count - 1].size == 0) --count;
  for (const PrefixCode& code : codes.first(count)) sizes.push_back(code.size);
  return count;
}

void write_header(std::span<const PrefixCode> codes, std::span<const PrefixCode> distance_codes, bool last,
                  BitWriter& bits) {
  static constexpr std::uint8_t order[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  std::vector<std::uint8_t> sizes;
  const std::size_t symbols = append_sizes(codes, first_length, sizes);
  const std::size_t distances = append_sizes(distance_codes, 1, sizes);
  const std::vector<HeaderStep> steps = header_steps(sizes);
  std::array<std::uint32_t, most_code_sizes> counts{};
  for (const HeaderStep& step : steps) ++counts[step.symbol];
  std::array<PrefixCode, most_code_sizes> size_codes;
  make_prefix_codes(counts, 7, size_codes);
  std::size_t listed = most_code_sizes;
  while (listed > 4 && size_codes[order[listed - 1]].size == 0) --listed;

  bits.put(last ? 1 : 0, 1);
  bits.put(2, 2);  // a block with codes of its own
  bits.put(symbols - first_length, 5);
  bits.put(distances - 1, 5);
  bits.put(listed - 4, 4);
  for (std::size_t i = 0; i < listed; ++i) bits.put(size_codes[order[i]].size, 3);
  for (const HeaderStep& step : steps) {
    bits.put(size_codes[step.symbol].bits, size_codes[step.symbol].size);
    bits.put(step.extra, step.extra_bits);
  }
}

}  // namespace

DeflateBlock::DeflateBlock()
    : tokens_(tokens_in_block),
      // A token takes at most 48 bits. The rest is for the header, and for the bytes beyond the end.
      bytes_(6 * tokens_in_block + 1024) {
  bits_.end = bytes_.data();
}

void DeflateBlock::add_match(std::size_t length, std::size_t distance) {
  const auto d = static_cast<std::uint32_t>(distance - 1), symbol = length_offset + static_cast<std::uint32_t>(length);
  const unsigned of_distance = distance_symbol(d);
  const std::uint32_t rest = d & ((1U << distance_extra(of_distance)) - 1);
  tokens_[count_++] = symbol | of_distance << distance_at | rest << rest_at;
  ++symbols_[symbol];
  ++distances_[of_distance];
}

void DeflateBlock::write_tokens(std::span<const PrefixCode> codes, std::span<const PrefixCode> distance_codes) {
  struct Bits {
    std::uint32_t bits = 0, count = 0;
  };
  // A length has its extra bits in one piece with its code.
  std::array<Bits, 512> first{};
  for (std::size_t byte = 0; byte < 256; ++byte) first[byte] = {codes[byte].bits, codes[byte].size};
  for (std::size_t length = least_match; length <= most_match; ++length) {
    const std::size_t symbol = symbol_of_length[length];
    const PrefixCode code = codes[first_length + symbol];
    const auto extra = static_cast<std::uint32_t>(length - length_symbols[symbol].base);
    first[length_offset + length] = {code.bits | extra << code.size,
                                     std::uint32_t{code.size} + length_symbols[symbol].extra};
  }
  std::array<Bits, 32> second{};
  std::array<std::uint32_t, 32> second_count{};  // with the extra bits
  for (std::size_t i = 0; i < most_distances; ++i) {
    second[i] = {distance_codes[i].bits, distance_codes[i].size};
    second_count[i] = distance_codes[i].size + distance_extra(i);
  }
  BitWriter bits = bits_;
  for (const std::uint32_t token : std::span(tokens_).first(count_)) {
    const std::uint32_t of_distance = token >> distance_at & 31;
    const Bits a = first[token & 1023], b = second[of_distance];
    bits.put(a.bits | (b.bits | std::uint64_t{token >> rest_at} << b.count) << a.count,
             a.count + second_count[of_distance]);
  }
  bits_ = bits;
}

void DeflateBlock::write(bool last, std::string& out) {
  std::array<std::uint32_t, most_symbols> counts{};
  std::copy_n(symbols_.begin(), 256, counts.begin());
  for (std::size_t length = least_match; length <= most_match; ++length)
    counts[first_length + symbol_of_length[length]] += symbols_[length_offset + length];
  counts[end_of_block] = 1;
  std::array<PrefixCode, most_symbols> codes;
  std::array<PrefixCode, most_distances> distance_codes;
  make_prefix_codes(counts, 15, codes);
  make_prefix_codes(std::span(distances_).first<most_distances>(), 15, distance_codes);

  write_header(codes, distance_codes, last, bits_);
  write_tokens(codes, distance_codes);
  bits_.put(codes[end_of_block].bits, codes[end_of_block].size);
  if (last) bits_.put(0, (8 - bits_.count) & 7);

  out.append(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::size_t>(bits_.end - bytes_.data()));
  bits_.end = bytes_.data();
  count_ = 0;
  symbols_.fill(0);
  distances_.fill(0);
}

}  // namespace carom
