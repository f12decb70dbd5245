#include "numerics/processors.h"

#include <sched.h>

#include <cstdlib>

#include "std.h"

namespace carom {
namespace {

size_t processes = 1;
size_t threads = 0;  // 0: a share of the processors

}  // namespace

size_t processors() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return size_t(max(CPU_COUNT(&set), 1));
}

void share_processors(size_t jobs) {
  processes = max<size_t>(jobs, 1);
  setenv("LP_NUM_THREADS", to_string(share_of_processors()).c_str(), 0);
}

void use_threads(size_t count) {
  threads = count;
  setenv("LP_NUM_THREADS", to_string(count).c_str(), 1);
}

size_t share_of_processors() {
  if (threads > 0) return threads;
  return max<size_t>(1, processors() / processes);
}

}  // namespace carom
