// Huffman's tree by two queues: sorted leaves, and inner nodes, which arise in the order of their weights.
// Where the tree is too deep, leaves move as in zlib's gen_bitlen: the sizes stay a complete code, and are near the
// best ones. The best ones (package merge) take longer, and pictures never reach the limit in practice.
#include "export/huffman.h"

#include <algorithm>
#include <array>
#include <vector>

namespace carom {
namespace {

constexpr unsigned most_bits = 15;

struct Leaf {
  std::uint32_t count;
  std::uint32_t symbol;
};

/// The symbols that occur, rare ones first. At least two.
std::vector<Leaf> sorted_leaves(std::span<const std::uint32_t> counts) {
  std::vector<Leaf> leaves;
  for (std::uint32_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) leaves.push_back({counts[i], i});
  for (std::uint32_t i = 0; leaves.size() < 2; ++i)
    if (counts[i] == 0) leaves.push_back({0, i});
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return a.count != b.count ? a.count < b.count : a.symbol < b.symbol; });
  return leaves;
}

/// The depth of each leaf in Huffman's tree.
std::vector<unsigned> depths(const std::vector<Leaf>& leaves) {
  const std::size_t count = leaves.size();
  std::vector<std::uint64_t> weights;               // of inner nodes
  std::vector<std::size_t> parents(2 * count - 1);  // leaves first, then inner nodes
  std::size_t leaf = 0, inner = 0;
  const auto take_lightest = [&](std::uint64_t& weight) {
    const bool is_leaf = inner == weights.size() || (leaf < count && leaves[leaf].count <= weights[inner]);
    weight += is_leaf ? leaves[leaf].count : weights[inner];
    parents[is_leaf ? leaf++ : count + inner++] = count + weights.size();
  };
  while (weights.size() + 1 < count) {
    std::uint64_t weight = 0;
    take_lightest(weight);
    take_lightest(weight);
    weights.push_back(weight);
  }
  std::vector<unsigned> depth(2 * count - 1, 0);
  for (std::size_t node = 2 * count - 2; node-- > 0;) depth[node] = depth[parents[node]] + 1;
  depth.resize(count);
  return depth;
}

/// How many codes have each size. Sizes beyond `longest` are cut, and leaves above make room for the cut ones.
std::array<unsigned, most_bits + 1> sizes_within(const std::vector<unsigned>& depth, unsigned longest) {
  std::array<unsigned, most_bits + 1> with_size{};
  for (const unsigned d : depth) ++with_size[std::min(d, longest)];
  // The sum of 2^-size over all codes, in units of 2^-longest. A complete code has 1.
  std::uint64_t used = 0;
  for (unsigned size = 1; size <= longest; ++size) used += std::uint64_t{with_size[size]} << (longest - size);
  for (; used > std::uint64_t{1} << longest; --used) {
    unsigned size = longest - 1;
    while (with_size[size] == 0) --size;
    // A leaf becomes an inner node, whose children are itself and one of the deepest leaves.
    --with_size[size];
    with_size[size + 1] += 2;
    --with_size[longest];
  }
  return with_size;
}

std::uint16_t reversed(unsigned code, unsigned size) {
  unsigned bits = 0;
  for (unsigned i = 0; i < size; ++i) bits |= (code >> i & 1) << (size - 1 - i);
  return static_cast<std::uint16_t>(bits);
}

}  // namespace

void make_prefix_codes(std::span<const std::uint32_t> counts, unsigned longest, std::span<PrefixCode> codes) {
  const std::vector<Leaf> leaves = sorted_leaves(counts);
  const std::array<unsigned, most_bits + 1> with_size = sizes_within(depths(leaves), longest);
  std::fill(codes.begin(), codes.end(), PrefixCode{});
  auto leaf = leaves.begin();
  for (unsigned size = longest; size > 0; --size)
    for (unsigned i = 0; i < with_size[size]; ++i) codes[leaf++->symbol].size = static_cast<std::uint8_t>(size);
  // Codes of one size are consecutive numbers in the order of their symbols.
  std::array<unsigned, most_bits + 1> next{};
  for (unsigned size = 1; size <= longest; ++size)
    next[size] = (next[size - 1] + (size > 1 ? with_size[size - 1] : 0)) << 1;
  for (PrefixCode& code : codes)
    if (code.size > 0) code.bits = reversed(next[code.size]++, code.size);
}

}  // namespace carom
