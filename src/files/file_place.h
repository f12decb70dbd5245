#pragma once
// Descriptors of files and folders, and the error of an access to them.

#include "files/export_error.h"
#include "std.h"

namespace carom {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  int release();
  void reset();

 private:
  int number_;
};

/// An open folder. Everything in it is accessed through its descriptor, so that no name leads out of it.
struct FilePlace {
  int folder = -1;
  /// For messages, as given by the user.
  string path;
  /// Temporary files of an interrupted run stay, to be continued (OutputFile::go_on).
  bool goes_on = false;
};

/// The place of an open file or folder, from its descriptor alone.
FilePlace place_of(int descriptor);

/// Whether this errno means that the entry is absent. Any other one is a failure and reveals nothing about the entry.
bool is_absent(int error);

/// Throws ExportError: "cannot <what> <path>/<name>: <reason>". The reason is errno's unless it is given.
[[noreturn]] void fail(const string& what, const FilePlace& place, string_view name, const string& reason = {});

}  // namespace carom
