#pragma once
// Bytes where the program expects a file: in memory, or in its own folder.
#include <string>
#include <string_view>

#include "files/output_file.h"

namespace carom::fuzz {

/// A file without a name in any folder; its path opens it as long as this lives.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  const std::string& path() const { return path_; }
  /// Another descriptor of it, at its beginning.
  Descriptor open() const;

 private:
  Descriptor file_;
  std::string path_;
};

/// A new folder, in memory if possible, removed at the end of the program.
class OwnFolder {
 public:
  OwnFolder();
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  int descriptor() const { return folder_.get(); }
  const std::string& path() const { return path_; }
  /// Writes a file in it, replacing a former one.
  void put(const std::string& name, std::string_view bytes) const;

 private:
  std::string path_;
  Descriptor folder_;
};

/// The file's bytes.
std::string bytes_of(const std::string& path);
/// All regular files below a folder with this ending (".yaml"), sorted.
std::vector<std::string> files_below(const std::string& folder, const std::string& ending);

}  // namespace carom::fuzz
