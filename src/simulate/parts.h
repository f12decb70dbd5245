#pragma once
// What hangs together: numbers 0 .. n-1, joined two by two (union-find with path halving).
#include <cstdint>
#include <numeric>
#include <vector>

namespace carom {

class Parts {
 public:
  explicit Parts(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The one that stands for all of k's part.
  std::uint32_t root(std::uint32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace carom
