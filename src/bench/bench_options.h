#pragma once
// Options of a bench: the steps, and the time limits.
#include <optional>

#include "scene/simulate_settings.h"

namespace carom {

struct BenchOptions {
  std::optional<double> longest, shortest;  // s, the limits of the steps; none: chosen by the scene
  int repeat = 5;                           // maximum of timed runs of each row
  double budget = 20;                       // s of CPU time for the whole scene, approximate
  /// exact or stepped. None: exact if it supports the whole scene.
  std::optional<Engine> reference;
};

}  // namespace carom
