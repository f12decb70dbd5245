#pragma once
// What a sweep says of itself, for people or as JSON.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/command_line.h"
#include "study/sweep_job.h"

namespace carom {

struct SweepOutcome {
  std::string status;                                         // "done", "up to date"
  std::size_t to_do = 0;                                      // runs that were not done before
  std::size_t runs = 0;                                       // of the whole sweep
  std::vector<std::pair<std::size_t, std::string>> failures;  // run, why
  double wall_s = 0;
  std::size_t doubtful = 0;  // runs of the whole sweep; of a part: not known
};

/// The end of a sweep, on stdout, and the runs that failed, on stderr.
void show_outcome(const Options& options, const SweepOutcome& outcome, const SweepJob& job);

/// With --json: that nothing came of it ("wrong", "interrupted", "failed"), and why.
void show_failure(const Options& options, std::string_view status, std::string_view error);

/// --plan: every run's id, values and whether it is done. Wants the job planned.
void show_plan(const Options& options, const SweepJob& job);

}  // namespace carom
