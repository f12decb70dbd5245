#pragma once
// Replaces the temporary files of libxlsxwriter.
// The library keeps the rows of a sheet and the parts of a workbook in temporary files, and ignores their errors.
// These files have no names, record every failure, and record a checksum of what was written to them.
// The finished workbook is compared with these checksums.
#include <cstdio>
#include <exception>

#include "files/part_file.h"
#include "std.h"

namespace carom {

/// Sets a function that is called often while a workbook is made. It may throw, and what makes the workbook passes that
/// on. It is set once, at the program's start. By default nothing is called.
void check_while_packing(function<void()> stop_check);
/// Calls it.
void check_packing();

class WorkbookFiles {
 public:
  /// While this object lives, the library's files are in the file system of `place`.
  /// `name`: the workbook's, for messages.
  /// Only one object may exist at a time.
  WorkbookFiles(const FilePlace& place, string name);
  ~WorkbookFiles();
  WorkbookFiles(const WorkbookFiles&) = delete;
  WorkbookFiles& operator=(const WorkbookFiles&) = delete;

  /// Files made from here on are parts of the workbook. The earlier ones hold rows.
  void begin_parts();

  /// Throws ExportError if a file could not be made, written or read, and what check_packing() has thrown meanwhile.
  void check() const;
  /// Calls check_packing(), and keeps what it throws. False: it has thrown, and all reading fails from here on.
  bool goes_on();
  /// Throws ExportError unless the workbook, a zip archive, has exactly the parts that were written, byte for byte.
  void check_archive(int archive) const;

  /// One temporary file.
  struct File {
    Descriptor descriptor;
    FILE* stream = nullptr;     // while it is open
    uint64_t at = 0, size = 0;  // bytes
    /// Checksum of all bytes, as in zip archives.
    uint32_t crc = 0;
  };
  /// A new file, or null on failure. check() then reports the failure.
  FILE* make();
  /// Records an error by its errno.
  void record_error(int error);

 private:
  FilePlace place_;
  string name_;
  vector<unique_ptr<File>> files_;
  /// The number of files with rows, which come first.
  size_t rows_ = 0;
  int error_ = 0;  // the first error
  std::exception_ptr stopped_{};
};

}  // namespace carom
