#pragma once
// What a run of a scene will write, said before it starts.
#include <cstdint>

namespace carom {

struct Scene;

/// How many trajectory rows, pictures and, roughly, bytes a run of this scene will write, and how long that and drawing
/// may take.
struct Forecast {
  std::uint64_t rows = 0, frames = 0, bytes = 0;
  double seconds = 0;
};
Forecast forecast(const Scene& scene);

}  // namespace carom
