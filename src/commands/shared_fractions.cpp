// A mapping without a file, inherited by forked workers. A pipe would need a reader between the results of tasks.
#include "commands/shared_fractions.h"

#include <sys/mman.h>

#include <new>

#include "std.h"

namespace carom {

static_assert(std::atomic<double>::is_always_lock_free, "a lock would belong to one process");

SharedFractions::SharedFractions(size_t count) : count_(count) {
  void* memory = count == 0 ? MAP_FAILED
                            : mmap(nullptr, count * sizeof(std::atomic<double>), PROT_READ | PROT_WRITE,
                                   MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  shared_ = static_cast<std::atomic<double>*>(memory);
  for (size_t i = 0; i < count; ++i) new (shared_ + i) std::atomic<double>(0);
}

SharedFractions::~SharedFractions() {
  if (shared_ != nullptr) munmap(shared_, count_ * sizeof(std::atomic<double>));
}

double SharedFractions::sum() const {
  double sum = 0;
  for (size_t i = 0; shared_ != nullptr && i < count_; ++i) sum += shared_[i].load(std::memory_order_relaxed);
  return sum;
}

}  // namespace carom
