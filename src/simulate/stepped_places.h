#pragma once
// The places of bodies in a list, found at once; for one list at a time.
#include <cstdint>
#include <span>
#include <vector>

#include "physics/world.h"

namespace carom {

class BodyPlaces {
 public:
  explicit BodyPlaces(std::size_t bodies) : place_(bodies, ~std::uint32_t{0}) {}

  /// Notes the places of the list's bodies, from place `from` on.
  void number(std::span<const Entity> list, std::size_t from = 0) {
    for (std::size_t k = from; k < list.size(); ++k) place_[list[k]] = static_cast<std::uint32_t>(k);
  }
  /// Of a body of the list.
  std::uint32_t operator[](Entity i) const { return place_[i]; }
  /// Whether body i is in the list, which must be the one that was numbered last.
  bool in(std::span<const Entity> list, Entity i) const { return place_[i] < list.size() && list[place_[i]] == i; }

 private:
  std::vector<std::uint32_t> place_;  // by body
};

}  // namespace carom
