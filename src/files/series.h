#pragma once
// Files of one output in a folder of their own (frames/, vtk/, plots/). Each file is complete when its name appears.
#include <string>
#include <string_view>
#include <vector>

#include "files/open_folder.h"
#include "scene/output_kinds.h"

namespace carom {

class Series {
 public:
  /// Makes the folder. Both arguments must outlive this object. Throws ExportError, as all functions of this class do.
  Series(OpenFolder& folder, const FileSeries& files) : folder_(folder), files_(files), place_(folder.series(files)) {}
  void put(std::int64_t number, std::string_view bytes) { put(files_.name(number), bytes); }
  /// `name`: one of the series' names.
  void put(std::string name, std::string_view bytes);
  const std::vector<FileRecord>& records() const { return records_; }  // names relative to the run's folder

 private:
  OpenFolder& folder_;
  const FileSeries& files_;
  FilePlace place_;
  std::vector<FileRecord> records_;
};

}  // namespace carom
