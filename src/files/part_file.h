#pragma once
// A file under a temporary name until it is complete, and the basic types of this folder: place, record, error.

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

/// A file's entry in a manifest.
struct FileRecord {
  string name;  // relative to the run's folder
  uint64_t bytes = 0;
  string sha256;

  void keep(auto& archive) { archive(name, bytes, sha256); }
};

/// The entry of a requested file that the run gave up.
struct LeftOut {
  string name, why;
};

/// Whether `name` can only refer to an entry of the folder itself, and is not hidden.
bool is_plain_name(string_view name);

/// The temporary name of a file.
string part_name(string_view name);

/// Whether this errno means that the entry is absent. Any other one is a failure and reveals nothing about the entry.
bool is_absent(int error);

/// Throws ExportError: "cannot <what> <path>/<name>: <reason>". The reason is errno's unless it is given.
[[noreturn]] void fail(const string& what, const FilePlace& place, string_view name, const string& reason = {});

/// Throws ExportError if a folder has this name where a file is expected.
void refuse_folder(const FilePlace& place, const string& name);

/// Renames a complete file, replacing an existing file. Throws ExportError.
void give_name(int from, const string& part, const FilePlace& place, const string& name);

/// An unnamed file in the folder's file system, for reading and writing. Throws ExportError.
Descriptor nameless_file(const FilePlace& place);

class PartFile {
 public:
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Name, size and hash. Valid once the file is complete.
  const FileRecord& record() const { return record_; }
  /// Renames the file, which must be complete. Throws ExportError.
  void publish();
  /// From here on other code renames or removes the temporary file (publication.h).
  void hand_over() { handed_over_ = true; }
  bool is_handed_over() const { return handed_over_; }

 protected:
  /// Removes an abandoned temporary file, unless the run goes on. `name` must be plain and not a folder's. Throws
  /// ExportError.
  PartFile(const FilePlace& place, string name);
  /// A file that has no name.
  explicit PartFile(const FilePlace& place) : place_(place), handed_over_(true) {}
  /// Removes the temporary file unless it was renamed or handed over.
  ~PartFile();

  string part() const { return part_name(record_.name); }

  FilePlace place_;
  FileRecord record_;

 private:
  bool handed_over_ = false;
};

}  // namespace carom
