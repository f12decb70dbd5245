#pragma once
// Files of one output in a folder of their own (frames/, vtk/, plots/). Each file is complete when its name appears.
#include <mutex>

#include "files/folder_writer.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

class Series {
 public:
  /// Makes the folder. Both arguments must outlive this object. Throws ExportError, as all functions of this class do.
  Series(FolderWriter& folder, const FileSeries& files)
      : folder_(folder), files_(files), place_(folder.series(files)) {}
  /// Returns the file's name relative to the run's folder. May be called by several threads.
  string put(int64_t number, string_view bytes) { return put(number, files_.name(number), bytes); }
  /// `name`: one of the series' names. From one thread.
  string put(const string& name, string_view bytes);
  /// In the order of the numbers, or of the calls; names relative to the run's folder.
  vector<FileRecord> records() const;

  template <typename Archive>
  void keep(Archive& archive) {
    archive(records_);
    if constexpr (Archive::reads) archive.check(has_all());
  }

 private:
  bool has_all() const;

  string put(int64_t number, const string& name, string_view bytes);

  FolderWriter& folder_;
  const FileSeries& files_;
  FilePlace place_;
  mutable std::mutex mutex_;
  map<int64_t, FileRecord> records_;  // by number, changed under the mutex
};

}  // namespace carom
