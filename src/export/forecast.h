#pragma once
// Predicts what a run of a scene will write.

#include "files/summary.h"
#include "std.h"

namespace carom {

struct Scene;

/// The numbers of trajectory rows and pictures (the most, where a film slows down at an unknown time), a rough estimate
/// of the bytes, and of the time for writing and drawing.
struct Forecast {
  uint64_t rows = 0, frames = 0, bytes = 0;
  double seconds = 0;
  /// Those tables whose rows do not depend on what happens, or not beyond a bound.
  vector<TableSize> tables{};
};
Forecast forecast(const Scene& scene);

}  // namespace carom
