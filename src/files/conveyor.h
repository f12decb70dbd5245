#pragma once
// A queue of work for a background thread: items are filled by the sender and used by the thread, in order.
// A fixed number of items is reused, however many are sent.
#include <array>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace carom {

template <typename Item>
class Conveyor {
 public:
  /// The number of items: one is being filled, one is being used, and the others even out the pace.
  static constexpr std::size_t items = 4;

  /// `use` is called once for each item sent, and leaves the item ready to be filled again.
  /// The sender calls it for the first `alone` items, so that little work starts no thread.
  /// The thread calls it for the others.
  Conveyor(std::function<void(Item&)> use, std::uint64_t alone) : use_(std::move(use)), alone_(alone) {}
  /// Items that were sent and not yet used are dropped.
  ~Conveyor() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      end_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  Conveyor(const Conveyor&) = delete;
  Conveyor& operator=(const Conveyor&) = delete;

  /// The item to fill. It stays the same until it is sent.
  Item& item() { return items_[sent_ % items]; }

  /// Passes the item on and waits until another one is free. Throws what `use` threw for this item or an earlier one.
  void send() {
    if (!thread_.joinable() && (sent_ < alone_ || !start())) {
      use_(item());
      ++sent_;
      ++used_;
      return;
    }
    std::unique_lock lock(mutex_);
    ++sent_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return failure_ || sent_ - used_ < items; });
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Waits until all items sent are used. Throws what `use` threw.
  void finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || sent_ == used_; });
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Whether the thread is running.
  bool started() const { return thread_.joinable(); }

 private:
  /// False if the system cannot start a thread. The sender then does the work.
  bool start() {
    // The new thread blocks all signals, which belong to the thread that runs the scene.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return thread_.joinable();
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return end_ || used_ < sent_; });
      if (end_) return;
      lock.unlock();
      std::exception_ptr failure;
      try {
        use_(items_[used_ % items]);
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      failure_ = failure;
      ++used_;
      changed_.notify_all();
      if (failure) return;
    }
  }

  std::function<void(Item&)> use_;
  std::uint64_t alone_;
  std::array<Item, items> items_;
  std::mutex mutex_;
  std::condition_variable changed_;
  /// Changed under the mutex once the thread runs.
  std::uint64_t sent_ = 0, used_ = 0;
  std::exception_ptr failure_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace carom
