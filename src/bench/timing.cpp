// Measures CPU time and not wall time, in rounds over all tasks, and takes medians.
// The number of executions in a turn is doubled or more until the turn lasts long enough for the clock.
#include "bench/timing.h"

#include <ctime>

#include "std.h"

namespace carom {

namespace {

constexpr double resolved = 2e-3;  // s: the shortest time that is measured
constexpr int most_in_a_turn = 100'000;

/// In s, of one of `runs` executions.
double turn(const TimedTask& task, int runs) {
  const double start = cpu_time();
  for (int k = 0; k < runs; ++k) task.run();
  return (cpu_time() - start) / runs;
}

}  // namespace

double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

function<void()> stop_check_within(double share, const function<void()>& stop_check) {
  return [end = cpu_time() + share, &stop_check] {
    stop_check();
    if (cpu_time() > end) throw Overrun{};
  };
}

vector<double> time_in_turns(const vector<TimedTask>& tasks, const function<void(double)>& report_progress) {
  vector<int> runs;  // executions in a turn
  vector<vector<double>> times(tasks.size());
  int rounds = 0;

  // How many executions make a turn long enough for the clock.
  for (const TimedTask& task : tasks) {
    int many = 1;
    // A task that is timed only once takes long enough.
    while (task.repeats > 1 && many < most_in_a_turn) {
      const double once = turn(task, many);
      if (once * many >= resolved) break;
      const double enough = min<double>(most_in_a_turn, resolved / max(once, 1e-8));
      many = max(2 * many, int(enough));
    }
    runs.push_back(many);
    rounds = max(rounds, task.repeats);
  }

  for (int round = 0; round < rounds; ++round) {
    report_progress(double(round) / rounds);
    for (size_t k = 0; k < tasks.size(); ++k)
      if (round < tasks[k].repeats) times[k].push_back(turn(tasks[k], runs[k]));
  }

  vector<double> medians;
  for (vector<double>& all : times) {
    ranges::sort(all);
    medians.push_back(0.5 * (all[(all.size() - 1) / 2] + all[all.size() / 2]));
  }
  return medians;
}

}  // namespace carom
