#pragma once
// Values by body that most scenes do not need. They take memory from the first write on.
#include <deque>

#include "std.h"

namespace carom {

/// An array that is allocated at the first write. Until then every value is `common`.
template <typename T>
class LazyArray {
 public:
  explicit LazyArray(size_t size, T common = {}) : size_(size), common_(std::move(common)) {}
  const T& operator[](size_t i) const { return values_.empty() ? common_ : values_[i]; }
  T& write(size_t i) {
    if (values_.empty()) values_.assign(size_, common_);
    return values_[i];
  }
  bool empty() const { return values_.empty(); }
  size_t size() const { return size_; }

  void keep(auto& archive) {
    archive(values_);
    archive.check(values_.empty() || values_.size() == size_);
  }

 private:
  size_t size_;
  T common_;
  vector<T> values_;
};

/// An array of large values of which few are written. Each takes memory at its own first write. References stay valid.
template <typename T>
class SparseArray {
 public:
  explicit SparseArray(size_t size) : place_(size, 0) {}
  [[gnu::always_inline]] const T& operator[](size_t i) const {
    return place_[i] == 0 ? common_ : values_[place_[i] - 1];
  }
  T& write(size_t i) {
    uint32_t& place = place_.write(i);
    if (place == 0) {
      values_.emplace_back();
      place = uint32_t(values_.size());
    }
    return values_[place - 1];
  }

  void keep(auto& archive) { archive(place_, values_); }

 private:
  T common_{};
  LazyArray<uint32_t> place_;  // index in values_, plus one; 0: not written
  std::deque<T> values_;
};

}  // namespace carom
