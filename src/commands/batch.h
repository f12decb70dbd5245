#pragma once
// Runs the scenes of a command line one after another or in several processes, and prints them in their order.
#include <atomic>

#include "commands/command_line.h"
#include "commands/plan.h"
#include "commands/scene_outcome.h"
#include "std.h"

namespace carom {

struct Batch {
  function<bool(const PlannedScene&)> is_up_to_date;
  function<SceneOutcome(const PlannedScene&)> up_to_date;
  /// `done`: where the fraction done is stored (Progress::share). May throw Interrupted.
  function<SceneOutcome(const PlannedScene&, ProgressChoice, std::atomic<double>* done)> run;
  function<void(SceneOutcome)> settle;  // prints and counts, in the scenes' order
};

/// Settles every scene. Gives the exit code of an interrupt, or 0.
int run_batch(const Batch& batch, vector<PlannedScene>& scenes, const Options& options, string_view command);

}  // namespace carom
