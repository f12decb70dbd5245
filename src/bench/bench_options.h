#pragma once
// What a bench times, and for how long.
#include <optional>

#include "scene/simulate_settings.h"

namespace carom {

struct BenchOptions {
  std::optional<double> longest, shortest;  // s, of the steps; none: by the scene
  int repeat = 5;                           // timed runs of each row, at most
  double budget = 20;                       // s of CPU time for the whole scene, roughly
  std::optional<Engine> reference;          // exact or stepped; none: exact if it has all that the scene asks for
};

}  // namespace carom
