// Each thread takes the next part that is not taken. A thread keeps its memory for all pictures.
#include "raster/threads.h"

#include <atomic>
#include <charconv>
#include <cstdlib>
#include <thread>

#include "std.h"

namespace carom::raster {

int drawing_threads() {
  const char* const text = std::getenv("LP_NUM_THREADS");
  const string_view words = text ? text : "";
  int count = 0;
  if (std::from_chars(words.data(), words.data() + words.size(), count).ec != std::errc())
    count = int(std::thread::hardware_concurrency());
  return std::clamp(count, 1, 64);
}

void Threads::run(int count, const Task& task) {
  std::atomic<int> next{0};  // part
  team_.run([&](int thread) {
    for (int part; (part = next.fetch_add(1)) < count;) task(memories_[size_t(thread)], part);
  });
}

void Threads::draw(const Picture& picture) {
  run(picture.bins->count(), [&](TileMemory& memory, int tile) { draw_tile(picture, memory, tile); });
}

}  // namespace carom::raster
