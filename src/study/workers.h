#pragma once
// Runs tasks in several processes.
// A process that crashes, or that the system kills for its memory, does not affect the others.

#include "std.h"

namespace carom {

/// The result of a task.
struct TaskOutcome {
  enum class Kind : unsigned char { done, failed, lost };
  size_t task = 0;
  Kind kind = Kind::done;
  /// done: the result of the work. failed: the text of its exception. lost: how its process ended.
  string text;
};

struct Tasks {
  function<optional<size_t>()> next;  // the next task, or none
  function<string(size_t)> work;      // executed in a worker process
  /// Executed in this process, in the order in which tasks end.
  function<void(const TaskOutcome&)> done;
  /// Executed in this process, often. If it throws, all workers are ended.
  function<void()> stop_check;
};

/// Executes all tasks in `jobs` processes. The calling process must have no other threads.
/// Throws std::system_error if no process can be started, and what the functions executed in this process throw.
void work_off(const Tasks& tasks, size_t jobs);

}  // namespace carom
