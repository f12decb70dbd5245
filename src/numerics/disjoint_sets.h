#pragma once
// Disjoint sets of the numbers 0 .. n-1, united two by two (union-find with path halving).
#include <numeric>

#include "std.h"

namespace carom {

class DisjointSets {
 public:
  /// Each number is a set of its own.
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The number that represents k's set.
  uint32_t root(uint32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  /// Unites the sets of a and b. The root of b represents the union.
  void join(uint32_t a, uint32_t b) { parent_[root(a)] = root(b); }

 private:
  vector<uint32_t> parent_;
};

}  // namespace carom
