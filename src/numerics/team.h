#pragma once
// Threads that do the parts of one task together, again and again.

#include "std.h"

namespace carom {

class Team {
 public:
  /// Starts `count` - 1 threads, or as many as the system has left. They block all signals.
  explicit Team(int count);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// The number of threads, with the caller.
  int size() const;

  /// One thread's part of a task, by the thread's number.
  using Task = function<void(int thread)>;
  /// Calls the task once for each number from 0 to size() - 1, 0 by the caller. Returns when all are
  /// done, or throws what one of them has thrown.
  void run(const Task& task);

 private:
  struct Impl;
  unique_ptr<Impl> impl_;
};

}  // namespace carom
