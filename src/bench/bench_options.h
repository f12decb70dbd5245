#pragma once
// The options of a bench, and how it is watched.

#include "scene/simulate_settings.h"
#include "std.h"

namespace carom {

struct BenchOptions {
  /// In s, the limits of the steps. None: chosen by the scene.
  optional<double> longest, shortest;
  /// Maximum of timed runs of each row.
  int repeat = 5;
  /// In s of CPU time for the whole scene, approximate.
  double budget = 20;
  /// exact or stepped. None: exact if it supports the whole scene.
  optional<Engine> reference;
};

struct BenchWatch {
  /// Called often. May throw.
  function<void()> stop_check;
  function<void(double done, const string& what)> report_progress;  // done: 0 to 1
};

}  // namespace carom
