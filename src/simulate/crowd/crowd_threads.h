#pragma once
// The parts of a crowd by several threads. What they do does not depend on the number of threads.
#include <chrono>

#include "numerics/team.h"
#include "simulate/crowd/crowd_rows.h"
#include "std.h"

namespace carom {

class CrowdThreads {
 public:
  /// They start when there are several slabs, and no more of them than slabs.
  explicit CrowdThreads(int count) : count_(size_t(count)) {}

  /// Calls what(part) for each part of the rows, in any order.
  template <typename What>
  void each(const CrowdRows& rows, const What& what) {
    const auto phase = rows.phases();
    run(rows, [&](size_t thread, size_t threads) {
      for (size_t k = 0; k + 1 < phase.size(); ++k) share(phase[k], phase[k + 1], thread, threads, what);
    });
  }
  /// The same, phase by phase.
  template <typename What>
  void in_phases(const CrowdRows& rows, const What& what) {
    const auto phase = rows.phases();
    for (size_t k = 0; k + 1 < phase.size(); ++k) {
      const auto task = [&](size_t thread, size_t threads) { share(phase[k], phase[k + 1], thread, threads, what); };
      if (phase[k + 1] - phase[k] > 1)
        run(rows, task);
      else
        task(0, 1);
    }
  }
  /// Calls what(slab) for each slab.
  template <typename What>
  void each_slab(const CrowdRows& rows, const What& what) {
    const size_t slabs = rows.first.size() - 1;
    run(rows, [&](size_t thread, size_t threads) { share(0, slabs, thread, threads, what); });
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Calls task(thread, threads) by all threads, or by this one where there is one slab.
  template <typename Task>
  void run(const CrowdRows& rows, const Task& task) {
    const size_t useful = min(count_, rows.first.size() - 1);
    if (useful < 2) return task(0, 1);
    if (started_ < useful) {
      team_.emplace(int(useful));
      started_ = useful;
    }
    if (alone_ > 0) {
      --alone_;
      return task(0, 1);
    }

    const size_t threads = min(size_t(team_->size()), useful);
    const Clock::time_point begin = Clock::now();
    Clock::time_point own = begin;
    team_->run([&](int thread) {
      if (size_t(thread) < threads) task(size_t(thread), threads);
      if (thread == 0) own = Clock::now();
    });
    count(own - begin, Clock::now() - own, threads);
  }
  /// Where other programs have the processors, threads wait for one another most of the time. This one then works alone
  /// for a while, and for twice as long each time that this happens again.
  void count(Clock::duration work, Clock::duration wait, size_t threads) {
    work_ += static_cast<Clock::rep>(threads - 1) * work;
    wait_ += wait;
    if (++tasks_ < 256) return;
    pause_ = wait_ > work_ ? clamp(2 * pause_, 1, 64) : 0;
    alone_ = pause_ * tasks_;
    tasks_ = 0;
    work_ = wait_ = {};
  }
  /// A thread's share of the numbers from `begin` to `end` - 1, the same each time. The first thread has as many as
  /// any.
  template <typename What>
  static void share(size_t begin, size_t end, size_t thread, size_t threads, const What& what) {
    const size_t count = end - begin;
    const auto share_from = [&](size_t t) { return (t * count + threads - 1) / threads; };
    for (size_t k = share_from(thread); k < share_from(thread + 1); ++k) what(begin + k);
  }

  size_t count_;
  int tasks_ = 0;           // since the last look at these times
  Clock::duration work_{};  // that the others have saved
  Clock::duration wait_{};  // for them
  int pause_ = 0;           // the last one, by the number of tasks after which they are looked at
  int alone_ = 0;           // tasks to come without them
  size_t started_ = 1;      // and as many as the system has left of them
  optional<Team> team_;
};

}  // namespace carom
