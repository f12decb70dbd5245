#pragma once
// A file that appears complete or not at all: written under a temporary name, hashed on the way, then renamed.

#include "files/conveyor.h"
#include "files/csv_dialect.h"
#include "files/gzip.h"
#include "files/hash.h"
#include "files/part_file.h"
#include "std.h"

namespace carom {

/// The part of a file that is written: what a run that goes on later needs to know of it.
struct WrittenPart {
  uint64_t bytes = 0;
  string sha256;
  string rest{};  // of a compressed file, what is not yet compressed

  void keep(auto& archive) { archive(bytes, sha256, rest); }
};

/// Writes are hashed and passed to the system in large pieces. A long file does this on a background thread.
class OutputFile : public PartFile {
 public:
  /// Opens `.name.part` in the folder. `name` must be plain. Throws ExportError, as all functions of this class do.
  OutputFile(const FilePlace& place, string name);
  /// The same of a table in a dialect. Where the name ends in .gz, what is written is compressed on the way.
  OutputFile(const FilePlace& place, string name, CsvDialect dialect);
  /// Writes to a file without a name (part_file.h), which is not published.
  OutputFile(const FilePlace& place, Descriptor nameless);

  CsvDialect dialect() const { return dialect_; }
  void write(string_view bytes);
  /// Room to write `size` bytes in place. A call of written(end) then gives the end of the bytes written.
  char* room(size_t size) {
    if (used_ + size > size_) make_room(size);
    return data_ + used_;
  }
  void written(const char* end) { used_ = size_t(end - data_); }

  /// Passes all bytes so far to the system. From here on the temporary file stays, even if the run fails.
  WrittenPart pause();
  /// Goes on behind this part of the temporary file that an interrupted run has left, in place of what was written to
  /// this object. Throws ArchiveError if the file does not have it.
  void go_on(const WrittenPart& part);

  /// Passes all bytes to the system and closes the file,
  /// which keeps its temporary name. record() is valid from here on.
  void complete();
  /// Completes the file and opens it again, to be read.
  Descriptor reopened();
  /// Completes the file and renames it to its final name.
  /// For the file to survive a power failure, the caller must sync the file system before.
  void publish();

 private:
  struct Piece {
    vector<char> bytes;
    size_t used = 0;
  };
  void open_part();
  void drain();
  void flush();
  void make_room(size_t size);
  void put(const Piece& piece);
  void put_bytes(string_view bytes);

  CsvDialect dialect_;
  optional<GzipMembers> gzip_;
  Descriptor file_;
  const bool has_name_;
  Sha256 hash_;
  /// Bytes that the system was requested to write to disk.
  uint64_t on_the_way_ = 0;
  // The piece being filled.
  char* data_ = nullptr;
  size_t size_ = 0, used_ = 0;
  /// Last, because its thread uses the members above.
  Conveyor<Piece> pieces_;
};

}  // namespace carom
