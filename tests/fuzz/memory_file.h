#pragma once
// Bytes where the program expects a file: in memory, or in its own folder.

#include "files/output_file.h"
#include "std.h"

namespace carom::fuzz {

/// A file without a name in any folder; its path opens it as long as this lives.
class MemoryFile {
 public:
  explicit MemoryFile(string_view bytes);
  const string& path() const { return path_; }
  /// Another descriptor of it, at its beginning.
  Descriptor open() const;

 private:
  Descriptor file_;
  string path_;
};

/// A new folder, in memory if possible, removed at the end of the program.
class OwnFolder {
 public:
  OwnFolder();
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  int descriptor() const { return folder_.get(); }
  const string& path() const { return path_; }
  /// Writes a file in it, replacing a former one.
  void put(const string& name, string_view bytes) const;

 private:
  string path_;
  Descriptor folder_;
};

/// The file's bytes.
string bytes_of(const string& path);
/// All regular files below a folder with this ending (".yaml"), sorted.
vector<string> files_below(const string& folder, const string& ending);

}  // namespace carom::fuzz
