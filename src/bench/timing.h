#pragma once
// CPU times, measured so that other work on the machine affects all tasks alike.

#include "std.h"

namespace carom {

/// CPU time of this process so far (s).
double cpu_time();

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
