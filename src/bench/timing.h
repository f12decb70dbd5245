#pragma once
// How long things take, on a machine that has other things to do.
#include <functional>
#include <vector>

namespace carom {

/// CPU time of this process so far (s).
double cpu_time();

struct TimedTask {
  std::function<void()> run;
  int repeats;  // how often it is timed, at least once
};

/// s of CPU time that each task takes once: the median of its repeats. The tasks take turns, so that a machine that is
/// slow for a while is slow for all; one too short for the clock runs several times in a turn. `tell` is called before
/// each round of turns, with the part that is done, 0 to 1.
std::vector<double> time_in_turns(const std::vector<TimedTask>& tasks, const std::function<void(double)>& tell);

}  // namespace carom
