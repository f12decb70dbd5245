#pragma once
// A file that appears whole or not at all: written beside its place, hashed on the way, then renamed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "export/conveyor.h"
#include "export/hash.h"

namespace carom {

/// A descriptor that closes itself.
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

/// An open folder. Everything in it is reached through its descriptor, so that no name leads out of it.
struct FilePlace {
  int folder = -1;
  std::string path;  // as the user knows it, for messages
};

/// What a manifest says of a file.
struct FileRecord {
  std::string name;  // beneath the run's folder
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// What it says of a file that was asked for and that the run gave up.
struct LeftOut {
  std::string name, why;
};

/// Whether `name` can only mean an entry of the folder it is looked up in, and no hidden one.
bool is_plain_name(std::string_view name);

/// The name under which a file is written until it is whole.
std::string part_name(std::string_view name);

/// Throws ExportError: "cannot <what> <path>/<name>: <reason>". The reason is errno's unless given.
[[noreturn]] void fail(const std::string& what, const FilePlace& place, std::string_view name,
                       const std::string& reason = {});

/// What is written is hashed and handed to the system in large pieces, by a thread of its own once there are many.
class OutputFile {
 public:
  /// Opens `.name.part` in the folder. `name` must be plain. Throws ExportError, as all of this class does.
  OutputFile(const FilePlace& place, std::string name);
  /// Without publish(): nothing of the file stays.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Room for `size` bytes to be written in place; written(end) then says how far they reach.
  char* room(std::size_t size) {
    if (used_ + size > size_) make_room(size);
    return data_ + used_;
  }
  void written(const char* end) { used_ = static_cast<std::size_t>(end - data_); }

  /// All bytes handed to the system, the file closed. Not yet under its own name.
  void complete();
  /// Gives the file its name. The caller has synced the file system if what was written must outlast a power cut.
  void publish();
  /// Name, size and hash; after complete().
  const FileRecord& record() const { return record_; }

 private:
  struct Piece {
    std::vector<char> bytes;
    std::size_t used = 0;
  };
  void flush();
  void make_room(std::size_t size);
  void put(const Piece& piece);

  FilePlace place_;
  FileRecord record_;
  Descriptor file_;
  Sha256 hash_;
  std::uint64_t on_the_way_ = 0;  // bytes of the file that the system was told to write to the disk
  bool published_ = false;
  // The piece that is being filled.
  char* data_ = nullptr;
  std::size_t size_ = 0, used_ = 0;
  Conveyor<Piece> pieces_;  // last: its thread uses what stands above
};

}  // namespace carom
