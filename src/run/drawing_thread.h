#pragma once
// A thread beside the one that runs a scene. It draws.
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "std.h"

namespace carom {

class DrawingThread {
 public:
  /// Starts `work`, or nothing if the system has no thread left: is_there().
  explicit DrawingThread(function<void()> work);
  /// Waits for the end.
  ~DrawingThread();
  DrawingThread(const DrawingThread&) = delete;
  DrawingThread& operator=(const DrawingThread&) = delete;

  bool is_there() const { return thread_.joinable(); }
  /// Throws what the work has thrown, if it has ended.
  void check() const;
  /// Waits for the end of the work and throws what it has thrown. `meanwhile` is called often, and may throw.
  void wait(const function<void()>& meanwhile);

 private:
  void run(const function<void()>& work);

  std::exception_ptr failure_;  // once ended_ is set
  std::atomic<bool> ended_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace carom
