#pragma once
// A part of a sweep. Parts agree on the division of runs without communication.

#include "std.h"

namespace carom {

/// Part `index` of `count`, counted from 1. Runs with the same motion are in the same part.
struct Shard {
  size_t index = 1, count = 1;
};

}  // namespace carom
