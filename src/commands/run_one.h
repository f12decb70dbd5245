#pragma once
// One planned scene -> its folder, and what is printed of it.
#include "commands/progress.h"
#include "commands/scene_outcome.h"

namespace carom {

/// What fails is in the outcome. Throws Interrupted.
SceneOutcome run_one(const PlannedScene& planned, const Options& options, const Style& style, Progress& progress);

}  // namespace carom
