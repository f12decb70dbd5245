#pragma once
// The bodies whose paths go anywhere, so that those asleep cost nothing.
#include <cstdint>
#include <span>
#include <vector>

#include "physics/world.h"

namespace carom {

class AwakeBodies {
 public:
  /// All are awake.
  explicit AwakeBodies(Entity bodies);

  /// Ascending where a step begins; later those that woke in it come last.
  std::span<const Entity> list() const { return list_; }
  void wake(Entity i);
  /// Keeps those of the list for which `stays_awake(i)`, which is asked once of each in the list's order; sorts it.
  template <typename StaysAwake>
  void keep_if(const StaysAwake& stays_awake) {
    std::size_t kept = 0;
    for (const Entity i : list_) {
      is_awake_[i] = stays_awake(i);
      if (is_awake_[i]) list_[kept++] = i;
    }
    list_.resize(kept);
    sort();
  }

 private:
  void sort();

  std::vector<Entity> list_;
  std::vector<std::uint8_t> is_awake_;  // by body
};

}  // namespace carom
