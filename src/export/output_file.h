#pragma once
// A file that appears whole or not at all: written beside its place, hashed on the way, then renamed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

/// Whether `name` can only mean an entry of the folder it is looked up in, and no hidden one.
bool is_plain_name(std::string_view name);

/// The name under which a file is written until it is whole.
std::string part_name(std::string_view name);

/// Throws ExportError: "cannot <what> <path>/<name>: <reason>". The reason is errno's unless given.
[[noreturn]] void fail(const std::string& what, const FilePlace& place, std::string_view name,
                       const std::string& reason = {});

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
    if (used_ + size > buffer_.size()) make_room(size);
    return buffer_.data() + used_;
  }
  void written(const char* end) { used_ = static_cast<std::size_t>(end - buffer_.data()); }

  /// All bytes handed to the system, the file closed. Not yet under its own name.
  void complete();
  /// Gives the file its name. The caller has synced the file system if what was written must outlast a power cut.
  void publish();
  /// Name, size and hash; after complete().
  const FileRecord& record() const { return record_; }

 private:
  void flush();
  void make_room(std::size_t size);

  FilePlace place_;
  FileRecord record_;
  Descriptor file_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  Sha256 hash_;
  bool published_ = false;
};

}  // namespace carom
