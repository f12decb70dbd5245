#pragma once
// The report of a sweep, as text or as JSON.

#include "commands/options.h"
#include "std.h"
#include "study/sweep_job.h"
#include "yaml/diagnostics.h"

namespace carom {

struct SweepOutcome {
  string status;                          // "done", "up to date"
  size_t to_do = 0;                       // runs that were not done yet
  size_t runs = 0;                        // of the whole sweep
  vector<pair<size_t, string>> failures;  // run, why
  double wall_s = 0;
  size_t doubtful = 0;                     // runs of the whole sweep; unknown for a part
  vector<pair<string, string>> skipped{};  // runs that are left out, and the errors of their scenes
};

/// The end of a sweep, on stdout, and the runs that failed, on stderr. These functions give the exit code.
int show_outcome(const Options& options, const SweepOutcome& outcome, const SweepJob& job);

/// Runs of a sweep, or of a part of it, that ended before its last run.
struct SweepCut {
  size_t made = 0, failed = 0, not_run = 0;
};

/// With --json: the status of a sweep without a result, by its exit code, and the reasons. `cut`: also on stderr.
int show_failure(const Options& options, int code, const vector<ErrorRecord>& errors,
                 const optional<SweepCut>& cut = nullopt);

/// --plan: id, values and state of every run. The job must be planned.
int show_plan(const Options& options, const SweepJob& job);

}  // namespace carom
