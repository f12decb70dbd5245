#pragma once
// Setup of a sweep from the command line, for sweep, gather and submit.

#include "commands/options.h"
#include "scene/sweep.h"
#include "std.h"
#include "study/sweep_job.h"

namespace carom {

/// The helps of options that sweep and submit share.
inline constexpr string_view repeat_help = "N seeds of each run, from the scene's on, or from --seed on",
                             measures_help = "further columns of summary.csv, such as\nballs.red.speed_m_per_s",
                             seed_help =
                                 "the seed of every run and of --random and --latin; with\nrepeats, the first one";

/// The sweep file, or the scene with --grid, with what the command line changes. Throws SceneError and UsageError.
Sweep read_sweep(const Options& options);

/// Where its runs go.
string sweep_folder_of(const Options& options);

/// Settings of its runs; without --shard a job array's task runs its own part.
SweepSettings sweep_settings(const Options& options);

/// Checks measures and charts against the first valid scenario; plan() reports errors of the scenario itself. Throws
/// SceneError.
void check_comparison(SweepJob& job);

/// What authors may not expect of scenarios that begin with a former run, by the first valid one. Empty: nothing.
vector<string> notes_on_start(SweepJob& job);

/// The part of a job array's task, by SLURM_ARRAY_TASK_ID, _MIN, _STEP and _COUNT; without these everything. Throws
/// UsageError.
Shard shard_of(const Options& options);

}  // namespace carom
