// Each thread takes the next part that is not taken. A thread keeps its memory for all pictures.
#include "raster/threads.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

namespace carom::raster {

int drawing_threads() {
  const char* const text = std::getenv("LP_NUM_THREADS");
  const std::string_view words = text ? text : "";
  int count = 0;
  if (std::from_chars(words.data(), words.data() + words.size(), count).ec != std::errc())
    count = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(count, 1, 64);
}

struct Threads::Impl {
  void work(TileMemory& memory) {
    for (int i; (i = next.fetch_add(1)) < count;) (*task)(memory, i);
  }

  void wait_for_work() {
    TileMemory own_memory;
    std::uint64_t done = 0;
    for (;;) {
      {
        std::unique_lock lock(mutex);
        begins.wait(lock, [&] { return ended || tasks > done; });
        if (ended) return;
        done = tasks;
      }
      work(own_memory);
      const std::lock_guard lock(mutex);
      if (--busy == 0) ends.notify_one();
    }
  }

  std::mutex mutex;
  std::condition_variable begins, ends;
  const Task* task = nullptr;
  int count = 0;             // parts of the task
  std::atomic<int> next{0};  // part
  std::uint64_t tasks = 0;   // begun so far
  std::size_t busy = 0;      // threads
  bool ended = false;
  TileMemory callers_memory;
  std::vector<std::thread> threads;
};

Threads::Threads(int count) : impl_(std::make_unique<Impl>()) {
  try {
    for (int i = 1; i < count; ++i) impl_->threads.emplace_back([this] { impl_->wait_for_work(); });
  } catch (const std::system_error&) {
    // Fewer threads draw the same pictures.
  }
}

Threads::~Threads() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->ended = true;
  }
  impl_->begins.notify_all();
  for (std::thread& thread : impl_->threads) thread.join();
}

void Threads::run(int count, const Task& task) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->task = &task;
    impl_->count = count;
    impl_->next = 0;
    impl_->busy = impl_->threads.size();
    ++impl_->tasks;
  }
  impl_->begins.notify_all();
  impl_->work(impl_->callers_memory);
  std::unique_lock lock(impl_->mutex);
  impl_->ends.wait(lock, [&] { return impl_->busy == 0; });
}

void Threads::draw(const Picture& picture) {
  run(picture.bins->count(), [&](TileMemory& memory, int tile) { draw_tile(picture, memory, tile); });
}

}  // namespace carom::raster
