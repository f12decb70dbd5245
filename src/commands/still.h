#pragma once
// carom render DIR --at SECONDS: one picture of a run.
#include "commands/scene_outcome.h"

namespace carom {

/// Draws the picture of a planned run at options.at, and writes it into the run's planned folder. Failures are in the
/// outcome. Throws Interrupted.
SceneOutcome still_of(const PlannedScene& planned, const Options& options);

}  // namespace carom
