#pragma once
// A child process: started from a list of arguments and never by a shell, with input, time limits and captured output.
#include <sys/types.h>

#include <atomic>
#include <chrono>

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// Sets a function that is called 20 times a second while waiting for any child process, on the thread that waits.
/// It may throw, and the function that waits passes the exception on.
/// It is set once, at the program's start. By default nothing is called.
void check_while_waiting(function<void()> stop_check);

/// The absolute path of a program on PATH, or none. Throws ExportError if the search fails.
optional<string> find_program(const string& name);

class Child {
 public:
  /// Starts the program arguments[0] (a path) in the folder `folder` (a descriptor). Throws ExportError.
  /// It inherits only its standard streams: an input that send() feeds or an empty one, and outputs that are captured.
  Child(const vector<string>& arguments, int folder, bool fed);
  /// Kills the program if it is still running.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  enum class Sent { all, closed, stuck, abandoned };
  /// Sends bytes to the program's standard input. Throws what the function of check_while_waiting throws.
  /// - all: all bytes were taken.
  /// - closed: the program closed its input, in most cases because it ended.
  /// - stuck: it took nothing for `patience`.
  /// - abandoned: abandon() was called.
  Sent send(const void* bytes, size_t size, std::chrono::milliseconds patience);
  void end_input();

  /// Waits for the program's end and returns its exit code, or 128 + the number of the signal that ended it.
  /// None: still running, or abandoned. Throws what the function of check_while_waiting throws.
  optional<int> wait(std::chrono::milliseconds patience);
  void kill();
  /// Ends send() and wait(), which may run on another thread, within 50 ms.
  void abandon() { abandoned_ = true; }

  // The first megabyte of each output stream. Both throw ExportError.
  string output() const;  // the standard output so far
  string errors() const;  // the standard error so far

 private:
  bool has_ended();

  pid_t id_ = -1;
  optional<int> exit_code_;
  std::atomic<bool> abandoned_ = false;
  Descriptor input_, output_, errors_;
};

}  // namespace carom
