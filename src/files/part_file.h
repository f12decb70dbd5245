#pragma once
// A file under a temporary name until it is complete.

#include "files/file_place.h"
#include "files/folder_names.h"
#include "std.h"

namespace carom {

/// A file's entry in a manifest.
struct FileRecord {
  string name;  // relative to the run's folder
  uint64_t bytes = 0;
  string sha256;

  void keep(auto& archive) { archive(name, bytes, sha256); }
};

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
