// Tasks of a step take microseconds and follow one another closely. Whoever waits therefore looks for some
// microseconds before it sleeps.
#include "numerics/team.h"

#include <atomic>
#include <csignal>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "numerics/processor.h"
#include "std.h"

namespace carom {

namespace {

/// Looks before other threads may have the processor, and before this one sleeps.
constexpr int alone = 200;
constexpr int looks = 400;

/// Waits until a number is no longer `old`. Returns the new one.
int changed(const std::atomic<int>& number, int old) {
  for (int k = 0; k < looks; ++k) {
    if (const int now = number.load(std::memory_order_acquire); now != old) return now;
    if (k >= alone) {
      std::this_thread::yield();
      continue;
    }
    pause_loop();
  }
  number.wait(old, std::memory_order_acquire);
  return number.load(std::memory_order_acquire);
}

}  // namespace

struct Team::Impl {
  void work(int thread) {
    for (int done = 0;;) {
      done = changed(begun, done);
      if (ended) return;
      try_task(thread);
      if (busy.fetch_sub(1, std::memory_order_acq_rel) == 1) busy.notify_one();
    }
  }

  void try_task(int thread) {
    try {
      (*task)(thread);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  }

  void begin(int others) {
    busy.store(others, std::memory_order_relaxed);
    begun.fetch_add(1, std::memory_order_release);
    begun.notify_all();
  }

  // Written before `begun` changes, and read after it.
  const Task* task = nullptr;
  bool ended = false;

  std::mutex mutex;
  std::exception_ptr failure;  // of the present task

  alignas(64) std::atomic<int> begun{0};  // tasks so far
  alignas(64) std::atomic<int> busy{0};   // threads
  vector<std::thread> threads;
};

Team::Team(int count) : impl_(make_unique<Impl>()) {
  // Signals belong to the thread that runs the scene.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    for (int k = 1; k < count; ++k) impl_->threads.emplace_back([this, k] { impl_->work(k); });
  } catch (const std::system_error&) {
    // Fewer threads do the same.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Team::~Team() {
  impl_->ended = true;
  impl_->begin(0);
  for (std::thread& thread : impl_->threads) thread.join();
}

int Team::size() const {
  return int(impl_->threads.size()) + 1;
}

void Team::run(const Task& task) {
  impl_->task = &task;
  impl_->begin(size() - 1);
  impl_->try_task(0);
  for (int left; (left = impl_->busy.load(std::memory_order_acquire)) != 0;) changed(impl_->busy, left);
  if (impl_->failure) std::rethrow_exception(exchange(impl_->failure, nullptr));
}

}  // namespace carom
