#pragma once
// Another program at work: started from a list of arguments, never by a shell; fed, timed, listened to.
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/output_file.h"

namespace carom {

/// What is called 20 times a second while any other program is waited for; it may throw, to be heard by what waits. Set
/// once, where this program begins; without it waiting hears nothing.
void look_while_waiting(std::function<void()> look);

/// The absolute path of a program on PATH; none if it is not there. Throws ExportError where that cannot be said.
std::optional<std::string> find_program(const std::string& name);

class Child {
 public:
  /// Starts the program arguments[0] (a path) within the folder `folder` (a descriptor). It inherits nothing but its
  /// standard streams: an input that send() feeds, or an empty one, and outputs that are kept. Throws ExportError.
  Child(const std::vector<std::string>& arguments, int folder, bool fed);
  /// Kills the program if it still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  enum class Sent { all, closed, stuck };
  /// Hands bytes to the program's standard input: all of them; or it has closed its input (mostly: ended); or it took
  /// nothing for `patience`. Throws what the look throws.
  Sent send(const void* bytes, std::size_t size, std::chrono::milliseconds patience);
  void end_input();

  /// Waits for the program's end: its exit code, 128 + the number of the signal that ended it, or none: still running.
  /// Throws what the look throws.
  std::optional<int> wait(std::chrono::milliseconds patience);
  void kill();

  // Of these the first megabyte. Throw ExportError.
  std::string output() const;  // what it wrote to its standard output so far
  std::string errors() const;  // and to its standard error

 private:
  bool has_ended();

  pid_t id_ = -1;
  std::optional<int> exit_code_;
  Descriptor input_, output_, errors_;
};

}  // namespace carom
