#pragma once
// The report of a sweep, as text or as JSON.
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/command_line.h"
#include "study/sweep_job.h"
#include "yaml/diagnostics.h"

namespace carom {

struct SweepOutcome {
  std::string status;                                         // "done", "up to date"
  std::size_t to_do = 0;                                      // runs that were not done yet
  std::size_t runs = 0;                                       // of the whole sweep
  std::vector<std::pair<std::size_t, std::string>> failures;  // run, why
  double wall_s = 0;
  std::size_t doubtful = 0;                                    // runs of the whole sweep; unknown for a part
  std::vector<std::pair<std::string, std::string>> skipped{};  // runs that are left out, and the errors of their scenes
};

/// The end of a sweep, on stdout, and the runs that failed, on stderr.
void show_outcome(const Options& options, const SweepOutcome& outcome, const SweepJob& job);

/// Runs of a sweep, or of a part of it, that ended before its last run.
struct SweepCut {
  std::size_t made = 0, failed = 0, not_run = 0;
};

/// With --json: the status of a sweep without a result ("wrong", "interrupted", "failed"), and the reasons.
void show_failure(const Options& options, std::string_view status, const std::vector<ErrorRecord>& errors,
                  const std::optional<SweepCut>& cut = std::nullopt);
/// The line about it on stderr.
void show_cut(const Options& options, const SweepCut& cut);

/// --plan: id, values and state of every run. The job must be planned.
void show_plan(const Options& options, const SweepJob& job);

}  // namespace carom
