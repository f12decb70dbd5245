#pragma once
// The contacts of an island at the start of a step of constrained motion.
#include "simulate/island/island_step.h"
#include "std.h"

namespace carom {

class ExactGroup;

class ContactSearch {
 public:
  ContactSearch(const ExactBodies& bodies, const ExactGroup& group) : bodies_(bodies), group_(group) {}

  /// Finds the pairs of a step in contact, except those that are about to strike, and the load.
  void find(IslandStep& step) const;

 private:
  void find_touching(IslandStep& step) const;
  void find_strings(IslandStep& step, uint32_t k) const;
  double load_of(const IslandStep& step) const;
  void find_slow_speeds(IslandStep& step) const;
  void drop_striking(IslandStep& step) const;

  const ExactBodies& bodies_;
  const ExactGroup& group_;
};

}  // namespace carom
