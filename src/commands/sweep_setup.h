#pragma once
// A sweep of the command line, as sweep, gather and submit see it.
#include <string>

#include "commands/command_line.h"
#include "scene/sweep.h"
#include "study/sweep_job.h"

namespace carom {

/// The sweep file, or the scene with --grid, with what the command line changes. Throws SceneError and UsageError.
Sweep read_sweep(const Options& options);

/// Where its runs go.
std::string sweep_folder_of(const Options& options);

/// How its runs are made here; without --shard a job array's task does its own part.
SweepSettings sweep_settings(const Options& options);

/// Whether measures and charts mean something for the first scenario; if that is wrong itself, plan() tells. Throws
/// SceneError.
void check_comparison(SweepJob& job);

/// The part that a task of a job array does, by SLURM_ARRAY_TASK_ID, _MIN, _STEP and _COUNT; else everything. Throws
/// UsageError.
Shard shard_of(const Options& options);

}  // namespace carom
