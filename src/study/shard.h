#pragma once
// A part of a sweep. Parts agree on who does what without talking to one another.
#include <cstddef>

namespace carom {

/// One of `count` parts of a sweep, from 1 on. Runs that share a motion are in the same part.
struct Shard {
  std::size_t index = 1, count = 1;
};

}  // namespace carom
