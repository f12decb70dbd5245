#include "run/drawing_thread.h"

#include <chrono>
#include <csignal>
#include <system_error>

#include "std.h"

namespace carom {
namespace {

constexpr auto glance = std::chrono::milliseconds(20);

}  // namespace

DrawingThread::DrawingThread(function<void()> work) {
  // Signals belong to the thread that runs the scene.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    thread_ = std::thread([this, work = std::move(work)] { run(work); });
  } catch (const std::system_error&) {
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

DrawingThread::~DrawingThread() {
  if (thread_.joinable()) thread_.join();
}

void DrawingThread::run(const function<void()>& work) {
  try {
    work();
  } catch (...) {
    failure_ = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

void DrawingThread::check() const {
  if (ended_ && failure_) std::rethrow_exception(failure_);
}

void DrawingThread::wait(const function<void()>& meanwhile) {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, glance, [this] { return ended_.load(); })) {
    lock.unlock();
    meanwhile();
    lock.lock();
  }
  check();
}

}  // namespace carom
