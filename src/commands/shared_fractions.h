#pragma once
// How far each of several runs is, in memory that worker processes share with the process that started them.
#include <atomic>

#include "std.h"

namespace carom {

class SharedFractions {
 public:
  /// All are 0. If the system has no such memory, nothing is shared and all remain 0.
  explicit SharedFractions(size_t count);
  ~SharedFractions();
  SharedFractions(const SharedFractions&) = delete;
  SharedFractions& operator=(const SharedFractions&) = delete;

  /// For Progress::share. Null: nothing is shared.
  std::atomic<double>* at(size_t number) const { return shared_ == nullptr ? nullptr : shared_ + number; }
  double sum() const;

 private:
  size_t count_;
  std::atomic<double>* shared_ = nullptr;
};

}  // namespace carom
