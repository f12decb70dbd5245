#pragma once
// Memory for large arrays with scattered access, in pages of 2 MiB where the system has them. Addresses are then found
// without a walk through the tables of small pages.
#include <sys/mman.h>

#include <new>

#include "std.h"

namespace carom {

template <typename T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <typename U>
  explicit LargePages(const LargePages<U>&) {}

  T* allocate(size_t count) {
    const size_t bytes = count * sizeof(T);
    auto* const start = static_cast<T*>(::operator new(bytes, alignment));
    constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
    const auto address = reinterpret_cast<std::uintptr_t>(start);
    const std::uintptr_t from = (address + page - 1) & ~(page - 1), to = (address + bytes) & ~(page - 1);
    // The system may refuse. The pages are then small.
    if (from < to) madvise(reinterpret_cast<void*>(from), to - from, MADV_HUGEPAGE);
    return start;
  }
  void deallocate(T* start, size_t /*count*/) { ::operator delete(start, alignment); }

  bool operator==(const LargePages&) const = default;

 private:
  static constexpr std::align_val_t alignment{64};
};

template <typename T>
using LargeVector = vector<T, LargePages<T>>;

}  // namespace carom
