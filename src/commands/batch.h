#pragma once
// Runs the scenes of a command line one after another or in several processes, and prints them in their order.

#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/scene_outcome.h"
#include "std.h"

namespace carom {

/// Settles one planned scene. May throw Interrupted.
using SceneWork = function<SceneOutcome(const PlannedScene&, Progress&)>;

/// Settles planned scenes, each by `work`, and reports them. Returns the program's exit code.
int run_planned(const Options& options, vector<PlannedScene> scenes, const SceneWork& work);
/// The same by running them.
int run_planned(const Options& options, vector<PlannedScene> scenes);

}  // namespace carom
