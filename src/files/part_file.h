#pragma once
// A file under a part's name beside its place, until it is whole and gets its own; and what all of this folder calls a
// place, a record, a failure.
#include <cstdint>
#include <string>
#include <string_view>

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

/// The place of an open file or folder of which only the descriptor is known.
FilePlace place_of(int descriptor);

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

/// Whether this errno says that there is no such entry. Any other one is a failure, and says nothing of the entry.
bool is_absent(int error);

/// Throws ExportError: "cannot <what> <path>/<name>: <reason>". The reason is errno's unless given.
[[noreturn]] void fail(const std::string& what, const FilePlace& place, std::string_view name,
                       const std::string& reason = {});

/// Throws ExportError where a folder stands in the place of a file of this name.
void refuse_folder(const FilePlace& place, const std::string& name);

/// Renames what is whole, replacing a file. Throws ExportError.
void give_name(int from, const std::string& part, const FilePlace& place, const std::string& name);

/// A file without a name in the folder's file system, for reading and writing. Throws ExportError.
Descriptor nameless_file(const FilePlace& place);

class PartFile {
 public:
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Name, size and hash; of what is whole.
  const FileRecord& record() const { return record_; }
  /// Gives the file, which is whole, its name. Throws ExportError.
  void publish();
  /// From here on the part is named or removed by another (publication.h).
  void hand_over() { handed_over_ = true; }
  bool is_handed_over() const { return handed_over_; }

 protected:
  /// Removes a part that was left. `name` must be plain, and no folder's. Throws ExportError.
  PartFile(const FilePlace& place, std::string name);
  /// The part goes, unless it has its name or was handed over.
  ~PartFile();

  std::string part() const { return part_name(record_.name); }

  FilePlace place_;
  FileRecord record_;

 private:
  bool handed_over_ = false;
};

}  // namespace carom
