#pragma once
// Many short lists that grow and shrink, in few large pages: a list takes a block of four entries, or of a multiple.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "simulate/large_pages.h"

namespace carom {

class ListPool {
 public:
  /// A list's place. Zeroed: an empty one.
  struct List {
    std::uint32_t at = 0;       // in granules
    std::uint32_t count = 0;    // entries
    std::uint8_t capacity = 0;  // the block's kind
  };

  /// Null where it has never had an entry.
  std::uint32_t* data(const List& list) {
    return list.capacity == 0 ? nullptr : page_[list.at >> page_bits] + entries_in(list.at & page_mask);
  }
  const std::uint32_t* data(const List& list) const { return const_cast<ListPool*>(this)->data(list); }

  /// Whether more of the memory is in blocks that hold no list than a pool that has just been filled may leave: what is
  /// left of a page is less than the list that did not fit in.
  bool wasteful() const { return unused_ > used_ + page_granules; }
  /// Of a list of another pool: a copy here.
  void copy(const ListPool& from, List& list) {
    const List old = list;
    list.capacity = 0;
    if (old.count == 0) return;
    take(list, old.count);
    std::copy_n(from.data(old), old.count, data(list));
  }

  /// Room for `count` entries; what the list held is lost.
  void reserve(List& list, std::size_t count) {
    if (count <= room(list.capacity)) return;
    give_back(list);
    take(list, count);
  }

  /// Where an entry stands that the list holds.
  std::uint32_t* find(const List& list, std::uint32_t entry) {
    std::uint32_t* at = data(list);
#ifdef __SSE2__
    // A block's end is beyond the list's: what stands there is found only if it is not in the list.
    const __m128i wanted = _mm_set1_epi32(static_cast<int>(entry));
    for (;; at += granule)
      if (const int there = _mm_movemask_ps(
              _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at)), wanted))))
        return at + std::countr_zero(static_cast<unsigned>(there));
#else
    while (*at != entry) ++at;
    return at;
#endif
  }

  void push_back(List& list, std::uint32_t entry) {
    if (list.count == room(list.capacity)) {
      const List old = list;
      take(list, list.count + 1);
      std::copy_n(data(old), old.count, data(list));
      give_back(old);
    }
    data(list)[list.count++] = entry;
  }

 private:
  static constexpr std::size_t granule = 4;  // entries
  static constexpr std::uint32_t page_bits = 16, page_mask = (1u << page_bits) - 1;
  static constexpr std::size_t page_granules = std::size_t{1} << page_bits;
  static constexpr std::uint8_t in_steps = 16;  // kinds 1..16 are as many granules, from then on each is twice the last

  static std::size_t entries_in(std::size_t granules) {
    return granules * granule;
  }
  static std::size_t granules_of(std::uint8_t capacity) {
    return capacity <= in_steps ? capacity : std::size_t{in_steps} << (capacity - in_steps);
  }
  static std::size_t room(std::uint8_t capacity) {
    return entries_in(granules_of(capacity));
  }

  void take(List& list, std::size_t count) {
    std::uint8_t kind = 1;
    while (room(kind) < count) ++kind;
    list.capacity = kind;
    used_ += granules_of(kind);
    if (kind < free_.size() && !free_[kind].empty()) {
      unused_ -= granules_of(kind);
      list.at = free_[kind].back();
      free_[kind].pop_back();
      return;
    }
    const std::size_t granules = granules_of(kind), page = page_granules;
    if (left_ < granules) {
      for (; left_ > 0; ++next_, --left_) put_away(1, next_);  // the page's rest
      next_ = static_cast<std::uint32_t>(page_.size() << page_bits);
      left_ = std::max((granules + page - 1) / page, std::min<std::size_t>(page_.size(), 16)) * page;
      memory_.emplace_back(LargePages<std::uint32_t>().allocate(entries_in(left_)));
      for (std::size_t k = 0; k < left_ / page; ++k) page_.push_back(memory_.back().get() + k * entries_in(page));
    }
    list.at = next_;
    next_ += static_cast<std::uint32_t>(granules);
    left_ -= granules;
  }

  void give_back(const List& list) {
    if (list.capacity == 0) return;
    used_ -= granules_of(list.capacity);
    put_away(list.capacity, list.at);
  }
  void put_away(std::uint8_t kind, std::uint32_t at) {
    if (free_.size() <= kind) free_.resize(kind + std::size_t{1});
    free_[kind].push_back(at);
    unused_ += granules_of(kind);
  }

  struct Free {
    void operator()(std::uint32_t* memory) const { LargePages<std::uint32_t>().deallocate(memory, 0); }
  };
  std::vector<std::unique_ptr<std::uint32_t[], Free>> memory_;
  std::vector<std::uint32_t*> page_;
  std::vector<std::vector<std::uint32_t>> free_;  // by kind
  std::size_t used_ = 0, unused_ = 0;             // granules, in lists' blocks and in free ones
  std::uint32_t next_ = 0;
  std::size_t left_ = 0;  // granules from next_ on
};

}  // namespace carom
