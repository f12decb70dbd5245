#pragma once
// libxlsxwriter's temporary files, in place of those that it would make itself. It keeps a sheet's rows and each part
// of a workbook in such files and looks at no error of theirs. These have no name, remember every failure, and know
// what was written to them, which the finished workbook is held against.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "files/part_file.h"

namespace carom {

class WorkbookFiles {
 public:
  /// The library's files are in `place`'s file system while this lives; `name`: the workbook's, for messages. There is
  /// one at a time.
  WorkbookFiles(const FilePlace& place, std::string name);
  ~WorkbookFiles();
  WorkbookFiles(const WorkbookFiles&) = delete;
  WorkbookFiles& operator=(const WorkbookFiles&) = delete;

  /// Files that are made from here on are the workbook's parts; the former ones have rows.
  void begin_parts();

  /// Throws ExportError if a file could not be made, written or read.
  void check() const;
  /// Throws ExportError unless the workbook, a zip archive, has exactly the parts that were written, to the byte.
  void check_archive(int archive) const;

  /// One of the files.
  struct File {
    Descriptor descriptor;
    FILE* stream = nullptr;          // as long as it is open
    std::uint64_t at = 0, size = 0;  // bytes
    std::uint32_t crc = 0;           // of all bytes, as zip archives have it
  };
  /// A new file; none: it cannot be made, as check() says then.
  FILE* make();
  /// What became of it: errno.
  void remember(int error);

 private:
  FilePlace place_;
  std::string name_;
  std::vector<std::unique_ptr<File>> files_;
  std::size_t rows_ = 0;  // so many of them, the first, have rows
  int error_ = 0;         // the first one
};

}  // namespace carom
