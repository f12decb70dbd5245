#pragma once
// What is seen of a scene before it is run by simulating its beginning: the first collision, which bodies come into the
// picture and leave it, how long a run takes.
#include <optional>
#include <string>
#include <vector>

#include "physics/collision.h"
#include "physics/entity.h"
#include "run/engine.h"

namespace carom {

struct Scene;

/// A body comes into the picture or leaves it between the instant before and this one.
struct Crossing {
  Entity body;
  double time;  // s
  bool enters;
};

struct Foresight {
  std::optional<Collision> first;              // none: none before the duration
  std::string trouble;                         // why it is not known; empty: it is
  std::string failure;                         // what stops a run later on, as far as was looked; empty: nothing
  std::vector<Crossing> crossings;             // in order of time
  double watched_from = 0, watched_until = 0;  // s: crossings are known in between
  double every = 0;                            // s between the instants that were looked at; 0: none was
  bool cut = false;                            // the budget ended before the pictures do
  std::optional<double> simulate_s;            // wall time that the whole simulation takes, roughly; none: not known
};

/// By the exact simulator, whatever engine the scene names, to the first collision, and on while that takes no longer
/// than `budget` (s). `watch`: whether crossings are wanted.
Foresight foresee(const Scene& scene, const EngineChoice& engine, bool watch, double budget);

}  // namespace carom
