#include "simulate/stepped_awake.h"

#include <algorithm>
#include <numeric>

namespace carom {

AwakeBodies::AwakeBodies(Entity bodies) : list_(bodies), is_awake_(bodies, 1) {
  std::iota(list_.begin(), list_.end(), Entity{0});
}

void AwakeBodies::wake(Entity i) {
  if (!is_awake_[i]) list_.push_back(i);
  is_awake_[i] = 1;
}

void AwakeBodies::sort() {
  if (!std::is_sorted(list_.begin(), list_.end())) std::sort(list_.begin(), list_.end());
}

}  // namespace carom
