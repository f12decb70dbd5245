#pragma once
// A priority queue with one entry a body: a tournament tree, in which an entry that changes replays its games to the
// root, log2(n) comparisons and no moves of the entries themselves.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Before(i, j): whether entry i comes before entry j. A total order; between equals the lower number wins.
template <typename Before>
class Tournament {
 public:
  Tournament(std::uint32_t entries, Before before) : before_(before) {
    while (leaves_ < entries) leaves_ *= 2;
    winner_.assign(2 * static_cast<std::size_t>(leaves_), none);
    for (std::uint32_t i = 0; i < entries; ++i) winner_[leaves_ + i] = i;
    for (std::uint32_t node = leaves_ - 1; node > 0; --node) play(node);
  }

  std::uint32_t first() const { return winner_[1]; }  // none if there is no entry

  /// Call after entry i has changed.
  void update(std::uint32_t i) {
    for (std::uint32_t node = (leaves_ + i) / 2; node > 0; node /= 2) play(node);
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};

 private:
  void play(std::uint32_t node) {
    const std::uint32_t l = winner_[2 * node], r = winner_[2 * node + 1];
    winner_[node] = r == none || (l != none && !before_(r, l)) ? l : r;
  }

  Before before_;
  std::uint32_t leaves_ = 1;
  std::vector<std::uint32_t> winner_;
};

}  // namespace carom
