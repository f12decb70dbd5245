#pragma once
// Values by body of which most scenes need none: they take memory once the first is written.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace carom {

/// All at once. T: the value until then is `common`.
template <typename T>
class ByNeed {
 public:
  explicit ByNeed(std::size_t bodies, T common = {}) : bodies_(bodies), common_(std::move(common)) {}
  const T& operator[](std::size_t i) const { return values_.empty() ? common_ : values_[i]; }
  T& write(std::size_t i) {
    if (values_.empty()) values_.assign(bodies_, common_);
    return values_[i];
  }
  bool empty() const { return values_.empty(); }

 private:
  std::size_t bodies_;
  T common_;
  std::vector<T> values_;
};

/// One by one, for large values that few bodies have. References stay valid.
template <typename T>
class OneByOne {
 public:
  explicit OneByOne(std::size_t bodies) : place_(bodies, 0) {}
  const T& operator[](std::size_t i) const { return place_[i] == 0 ? common_ : values_[place_[i] - 1]; }
  T& write(std::size_t i) {
    std::uint32_t& place = place_.write(i);
    if (place == 0) {
      values_.emplace_back();
      place = static_cast<std::uint32_t>(values_.size());
    }
    return values_[place - 1];
  }

 private:
  T common_{};
  ByNeed<std::uint32_t> place_;  // in values_, and one; 0: none
  std::deque<T> values_;
};

}  // namespace carom
