#pragma once
// A file that appears whole or not at all: written beside its place, hashed on the way, then renamed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/conveyor.h"
#include "files/hash.h"
#include "files/part_file.h"

namespace carom {

/// What is written is hashed and handed to the system in large pieces, by a thread of its own once there are many.
class OutputFile : public PartFile {
 public:
  /// Opens `.name.part` in the folder. `name` must be plain. Throws ExportError, as all of this class does.
  OutputFile(const FilePlace& place, std::string name);

  void write(std::string_view bytes);
  /// Room for `size` bytes to be written in place; written(end) then says how far they reach.
  char* room(std::size_t size) {
    if (used_ + size > size_) make_room(size);
    return data_ + used_;
  }
  void written(const char* end) { used_ = static_cast<std::size_t>(end - data_); }

  /// All bytes handed to the system, the file closed. Not yet under its own name.
  /// record() tells of it from here on.
  void complete();
  /// Completes the file and gives it its name. The caller has synced the file system if what was written must outlast
  /// a power cut.
  void publish();

 private:
  struct Piece {
    std::vector<char> bytes;
    std::size_t used = 0;
  };
  void flush();
  void make_room(std::size_t size);
  void put(const Piece& piece);

  Descriptor file_;
  Sha256 hash_;
  std::uint64_t on_the_way_ = 0;  // bytes of the file that the system was asked to write to the disk
  // The piece that is being filled.
  char* data_ = nullptr;
  std::size_t size_ = 0, used_ = 0;
  Conveyor<Piece> pieces_;  // last: its thread uses what stands above
};

}  // namespace carom
