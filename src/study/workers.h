#pragma once
// Tasks by several processes at a time: one that crashes, or that the system kills for its memory, takes no other
// with it.
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace carom {

/// What became of a task.
struct TaskOutcome {
  enum class Kind : unsigned char { done, failed, lost };
  std::size_t task = 0;
  Kind kind = Kind::done;
  std::string text;  // done: what the work gave; failed: its exception's text; lost: how its process ended
};

struct Tasks {
  std::function<std::optional<std::size_t>()> next;  // the next task; none: there is none
  std::function<std::string(std::size_t)> work;      // in a process of its own
  std::function<void(const TaskOutcome&)> done;      // in this one, in the order in which tasks end
  std::function<void()> look;                        // in this one, often; may throw: then all processes are ended
};

/// How many processors this process may use, at least 1.
std::size_t processors();

/// Divides the processors among so many processes: each draws with its share of threads, unless LP_NUM_THREADS, which
/// OSMesa goes by, is set. To be called before there are threads.
void share_processors(std::size_t jobs);

/// Works off all tasks in `jobs` processes. The calling process must have no other threads. Throws std::system_error
/// where there can be no process, and what the functions of this process throw.
void work_off(const Tasks& tasks, std::size_t jobs);

}  // namespace carom
