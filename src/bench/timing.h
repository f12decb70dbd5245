#pragma once
// CPU times and their limits. They are measured so that other work on the machine affects all tasks alike.

#include "std.h"

namespace carom {

/// CPU time of this process so far (s).
double cpu_time();

/// Thrown when a run exceeds its CPU time.
struct Overrun {};

/// Calls `stop_check`, and throws Overrun once `share` (s) of CPU time has passed since this call.
function<void()> stop_check_within(double share, const function<void()>& stop_check);

struct TimedTask {
  function<void()> run;
  int repeats;  // number of timings, at least 1
};

/// The CPU time (s) of one execution of each task: the median of its repeats.
/// Tasks take turns, so that a machine that is slow for a while is slow for all.
/// A task too short for the clock is executed several times in a turn.
/// `report_progress` is called before each round of turns, with the share done, 0 to 1.
vector<double> time_in_turns(const vector<TimedTask>& tasks, const function<void(double)>& report_progress);

}  // namespace carom
