#pragma once
// Predicts what a run of a scene will write.

#include "files/summary.h"
#include "std.h"

namespace carom {

struct Scene;

/// The number of pictures (the most, where a film slows down at an unknown time), a rough estimate of the bytes, and of
/// the time for writing and drawing.
struct Forecast {
  uint64_t frames = 0, bytes = 0;
  double seconds = 0;
  /// Of tables whose rows are known, or a bound of them.
  vector<TableSize> tables{};
};
Forecast forecast(const Scene& scene);

}  // namespace carom
