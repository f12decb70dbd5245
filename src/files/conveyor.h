#pragma once
// A queue of work for background threads: items are filled by the sender and used by the threads.
// A fixed number of items is reused, however many are sent.
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "std.h"

namespace carom {

template <typename Item>
class Conveyor {
 public:
  /// `use` is called once for each item sent, and leaves the item ready to be filled again.
  /// The sender calls it for the first `alone` items, so that little work starts no thread.
  /// The threads call it for the others: one of them in order, several at the same time. Without any the sender does.
  Conveyor(function<void(Item&)> use, uint64_t alone, size_t threads = 1)
      : use_(std::move(use)),
        alone_(alone),
        most_threads_(threads),
        items_(threads == 0 ? 1 : threads + spare),
        busy_(items_.size()) {}
  /// Items that were sent and not yet used are dropped.
  ~Conveyor() {
    {
      const std::lock_guard lock(mutex_);
      end_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Conveyor(const Conveyor&) = delete;
  Conveyor& operator=(const Conveyor&) = delete;

  /// The number of items: one is being filled, each thread uses one, and the others even out the pace.
  size_t items() const { return items_.size(); }

  /// The item to fill. It stays the same until it is sent.
  Item& item() { return items_[sent_ % items_.size()]; }

  /// Passes the item on and waits until the next one is free. Throws what `use` threw for an item, the first sent of
  /// several.
  void send() {
    if (most_threads_ == 0 || (threads_.empty() && (sent_ < alone_ || !start()))) {
      use_(item());
      ++sent_;
      ++taken_;
      return;
    }
    std::unique_lock lock(mutex_);
    busy_[sent_ % busy_.size()] = true;
    ++sent_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return failure_ ? in_use_ == 0 : !busy_[sent_ % busy_.size()]; });
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Waits until all items sent are used. Throws what `use` threw.
  void finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return in_use_ == 0 && (failure_ || taken_ == sent_); });
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Whether a thread is running.
  bool started() const { return !threads_.empty(); }

 private:
  static constexpr size_t spare = 3;  // items beside those in use

  /// False if the system cannot start a thread. The sender then does the work.
  bool start() {
    // New threads block all signals, which belong to the thread that runs the scene.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
      while (threads_.size() < most_threads_) threads_.emplace_back([this] { run(); });
    } catch (const std::system_error&) {
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return !threads_.empty();
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return end_ || failure_ || taken_ < sent_; });
      if (end_ || failure_) return;

      // Use the next item, without the lock.
      const uint64_t number = taken_++;
      ++in_use_;
      lock.unlock();
      std::exception_ptr failure;
      try {
        use_(items_[number % items_.size()]);
      } catch (...) {
        failure = std::current_exception();
      }

      lock.lock();
      // Items are taken in order. All before a failed one are thus taken, and the first failure is known once they end.
      if (failure && (!failure_ || number < failed_)) {
        failure_ = failure;
        failed_ = number;
      }
      busy_[number % busy_.size()] = false;
      --in_use_;
      changed_.notify_all();
    }
  }

  function<void(Item&)> use_;
  uint64_t alone_;
  size_t most_threads_;
  vector<Item> items_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Changed under the mutex once a thread runs.
  vector<bool> busy_;  // by item: sent and not yet used
  uint64_t sent_ = 0, taken_ = 0;
  size_t in_use_ = 0;
  std::exception_ptr failure_;
  uint64_t failed_ = 0;  // the item of failure_
  bool end_ = false;
  vector<std::thread> threads_;
};

}  // namespace carom
