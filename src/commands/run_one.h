#pragma once
// One planned scene -> its folder and its report.
#include "commands/progress.h"
#include "commands/scene_outcome.h"

namespace carom {

/// Failures are in the outcome. Throws Interrupted.
SceneOutcome run_one(const PlannedScene& planned, const Options& options, const Style& style, Progress& progress);

}  // namespace carom
