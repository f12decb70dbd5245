#pragma once
// One planned scene -> its folder and its report.

#include "commands/progress.h"
#include "commands/scene_outcome.h"
#include "overlay/history.h"
#include "std.h"

namespace carom {

/// Failures are in the outcome. Throws Interrupted.
SceneOutcome run_one(const PlannedScene& planned, const Options& options, Progress& progress);

/// A function that makes a simulator of the recorded motion of a planned run. Empty: it has no record, and is simulated
/// again, which is said unless `quiet`.
function<unique_ptr<Simulator>(const Scene&)> replay_of(const PlannedScene& planned, const OverlayNeeds& needs,
                                                        bool quiet);

}  // namespace carom
