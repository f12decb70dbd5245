#pragma once
// Radix sort (Knuth, The Art of Computer Programming 3, 5.2.5) of numbers by floats.
#include <bit>

#include "std.h"

namespace carom::raster {

/// The numbers 0 to n - 1 in the order of n floats. Equals keep their order.
class SortedNumbers {
 public:
  /// Sorts. The memory of the last time is used again.
  void sort(const vector<float>& by) {
    const size_t count = by.size();
    pairs_.resize(count), spare_.resize(count), numbers_.resize(count);

    // How often each digit occurs.
    array<array<uint32_t, 2048>, 3> places{};
    for (size_t i = 0; i < count; ++i) {
      const uint32_t key = key_of(by[i]);
      pairs_[i] = {key, uint32_t(i)};
      for (size_t k = 0; k < 3; ++k) ++places[k][key >> 11 * k & 2047U];
    }

    // One pass for each digit.
    for (size_t k = 0; k < 3; ++k) {
      uint32_t next = 0;
      for (uint32_t& place : places[k]) {
        const uint32_t members = place;
        place = next, next += members;
      }

      for (const Keyed& pair : pairs_) spare_[places[k][pair.key >> 11 * k & 2047U]++] = pair;
      pairs_.swap(spare_);
    }

    for (size_t i = 0; i < count; ++i) numbers_[i] = pairs_[i].number;
  }
  const vector<uint32_t>& numbers() const { return numbers_; }

 private:
  struct Keyed {
    uint32_t key, number;
  };
  /// The order of these keys is that of the floats.
  static uint32_t key_of(float x) {
    const auto bits = std::bit_cast<uint32_t>(x);
    return bits & 0x80000000U ? ~bits : bits | 0x80000000U;
  }

  vector<Keyed> pairs_, spare_;
  vector<uint32_t> numbers_;
};

}  // namespace carom::raster
