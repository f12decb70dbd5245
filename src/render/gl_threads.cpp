// Checks that llvmpipe gets its drawing threads. If it cannot start one it waits for ever, and gives no error.
// So as many threads are started and ended before, and llvmpipe's own are counted by their names in /proc.
#include "render/gl_threads.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <system_error>
#include <thread>

#include "raster/threads.h"
#include "render/render_error.h"
#include "std.h"

namespace carom::gl {
namespace {

constexpr const char* variable = "LP_NUM_THREADS";
// llvmpipe starts at most so many.
constexpr unsigned most_threads = 16;
constexpr auto patience = std::chrono::seconds(2);

unsigned thread_count() {
  const int count = raster::drawing_threads();
  // The caller draws where there is one alone.
  return count > 1 ? min(unsigned(count), most_threads) : 0;
}

/// Whether the system can provide so many threads at once.
bool can_have(unsigned count) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  vector<std::thread> threads;
  bool all = true;
  try {
    while (threads.size() < count) threads.emplace_back([ended] { ended.wait(); });
  } catch (const std::system_error&) {
    all = false;
  }
  end.set_value();
  for (std::thread& thread : threads) thread.join();
  return all;
}

/// The number of this process' threads with a name of llvmpipe's drawing threads.
unsigned drawing_threads() {
  unsigned count = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator task("/proc/self/task", error), end; !error && task != end;
       task.increment(error)) {
    string name;
    std::ifstream(task->path() / "comm") >> name;
    count += name.starts_with("llvmpipe-");
  }
  return count;
}

unsigned chosen = 0;

}  // namespace

void choose_threads() {
  chosen = thread_count();
  // llvmpipe starts as many again for other work, and one for its cache.
  if (!can_have(2 * chosen + 1)) chosen = 0;
  setenv(variable, to_string(chosen).c_str(), 1);
}

void check_threads() {
  // A thread sets its own name, which takes a moment.
  const auto limit = std::chrono::steady_clock::now() + patience;
  while (drawing_threads() < chosen) {
    if (std::chrono::steady_clock::now() > limit)
      throw RenderError(
          "cannot draw: the system has no threads left. Remedy: end other programs or raise the limit of processes, "
          "or set LP_NUM_THREADS=0.");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace carom::gl
