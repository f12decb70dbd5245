#pragma once
// Many short lists that grow and shrink, in a few large pages. A list takes a block of four entries, or of a multiple
// of four.
#include <bit>

#include "numerics/large_pages.h"
#include "numerics/vectors.h"
#include "std.h"

namespace carom {

class ListPool {
 public:
  /// The place of a list. A zeroed one is an empty list.
  struct List {
    uint32_t at = 0;       // in granules
    uint32_t count = 0;    // entries
    uint8_t capacity = 0;  // kind of the block
  };

  /// Null where the list has never had an entry.
  uint32_t* data(const List& list) {
    return list.capacity == 0 ? nullptr : page_[list.at >> page_bits] + entries_in(list.at & page_mask);
  }
  const uint32_t* data(const List& list) const { return const_cast<ListPool*>(this)->data(list); }

  /// Whether more memory is in free blocks than a pool that was just filled may leave.
  /// The rest of a page is less than the list that did not fit into it.
  bool wasteful() const { return unused_ > used_ + page_granules; }
  /// Replaces a list of another pool by a copy in this pool.
  void copy(const ListPool& from, List& list) {
    const List old = list;
    list.capacity = 0;
    if (old.count == 0) return;
    take(list, old.count);
    std::copy_n(from.data(old), old.count, data(list));
  }

  /// Makes room for `count` entries. The list's contents are lost.
  void reserve(List& list, size_t count) {
    if (count <= room(list.capacity)) return;
    give_back(list);
    take(list, count);
  }

  /// The position of an entry that the list holds.
  uint32_t* find(const List& list, uint32_t entry) {
    uint32_t* at = data(list);
    // A block may end beyond the list. An entry there is found only if it is not in the list.
    typedef uint32_t Granule __attribute__((vector_size(4 * granule)));
    for (;; at += granule) {
      Granule entries;
      std::memcpy(&entries, at, sizeof entries);
      if (const unsigned there = bits_of(entries == entry)) return at + std::countr_zero(there);
    }
  }

  void push_back(List& list, uint32_t entry) {
    if (list.count == room(list.capacity)) {
      const List old = list;
      take(list, list.count + 1);
      std::copy_n(data(old), old.count, data(list));
      give_back(old);
    }
    data(list)[list.count++] = entry;
  }

 private:
  static constexpr size_t granule = 4;  // entries
  static constexpr uint32_t page_bits = 16;
  static constexpr uint32_t page_mask = (1u << page_bits) - 1;
  static constexpr size_t page_granules = size_t{1} << page_bits;
  // Kinds 1 to 16 have as many granules. Each later kind has twice as many as the one before.
  static constexpr uint8_t in_steps = 16;

  static size_t entries_in(size_t granules) { return granules * granule; }
  static size_t granules_of(uint8_t capacity) {
    return capacity <= in_steps ? capacity : size_t{in_steps} << (capacity - in_steps);
  }
  static size_t room(uint8_t capacity) { return entries_in(granules_of(capacity)); }

  void take(List& list, size_t count) {
    uint8_t kind = 1;
    while (room(kind) < count) ++kind;
    list.capacity = kind;
    used_ += granules_of(kind);

    // A free block of this kind.
    if (kind < free_.size() && !free_[kind].empty()) {
      unused_ -= granules_of(kind);
      list.at = free_[kind].back();
      free_[kind].pop_back();
      return;
    }

    // A block from the present page, or from new ones.
    const size_t granules = granules_of(kind);
    const size_t page = page_granules;
    if (left_ < granules) {
      // The rest of the page.
      for (; left_ > 0; ++next_, --left_) put_away(1, next_);
      next_ = uint32_t(page_.size() << page_bits);
      left_ = max((granules + page - 1) / page, min<size_t>(page_.size(), 16)) * page;
      memory_.emplace_back(LargePages<uint32_t>().allocate(entries_in(left_)));
      for (size_t k = 0; k < left_ / page; ++k) page_.push_back(memory_.back().get() + k * entries_in(page));
    }

    list.at = next_;
    next_ += uint32_t(granules);
    left_ -= granules;
  }

  void give_back(const List& list) {
    if (list.capacity == 0) return;
    used_ -= granules_of(list.capacity);
    put_away(list.capacity, list.at);
  }
  void put_away(uint8_t kind, uint32_t at) {
    if (free_.size() <= kind) free_.resize(kind + size_t{1});
    free_[kind].push_back(at);
    unused_ += granules_of(kind);
  }

  struct Free {
    void operator()(uint32_t* memory) const { LargePages<uint32_t>().deallocate(memory, 0); }
  };
  vector<unique_ptr<uint32_t[], Free>> memory_;
  vector<uint32_t*> page_;
  vector<vector<uint32_t>> free_;  // by kind
  size_t used_ = 0;                // granules, in the blocks of lists
  size_t unused_ = 0;              // granules, in free blocks
  uint32_t next_ = 0;
  size_t left_ = 0;  // granules from next_ on
};

}  // namespace carom
