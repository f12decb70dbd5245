#pragma once
// Numbered files in a folder of their own, each whole as soon as it is there: frames/, vtk/.
#include <string>
#include <string_view>
#include <vector>

#include "files/open_folder.h"

namespace carom {

class Series {
 public:
  /// Makes the folder. Both must outlive this. Throws ExportError, as all of this class does.
  Series(OpenFolder& folder, const FileSeries& files) : folder_(folder), files_(files), place_(folder.series(files)) {}
  void put(std::int64_t number, std::string_view bytes);
  const std::vector<FileRecord>& records() const { return records_; }  // named as beneath the run's folder

 private:
  OpenFolder& folder_;
  const FileSeries& files_;
  FilePlace place_;
  std::vector<FileRecord> records_;
};

}  // namespace carom
