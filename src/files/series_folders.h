#pragma once
// The folders within a run's folder that series of files have: frames/.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.h"
#include "scene/output.h"

namespace carom {

/// The output whose series has a file of this name beneath a run's folder, "frames/frame_00012.png"; null: none has.
const OutputKind* series_of(std::string_view name);

/// The output that has a file of this name; null: none has, or the scene gives the name (a film's).
const OutputKind* output_of(std::string_view name);

/// Whether a file of this name tells how things look: one of frames/, a film, what another program draws.
bool is_picture(std::string_view name);

/// Where a file of a run stands.
struct FileSpot {
  int folder = -1;   // -1: there is no such folder
  std::string name;  // in that folder
};

/// Opens each series' folder when it is asked for first; follows no link.
class SeriesFolders {
 public:
  /// `folder`: the run's; it must outlive this.
  explicit SeriesFolders(int folder) : folder_(folder) {}
  /// `name`: as in the manifest.
  FileSpot spot(std::string_view name);
  /// The folder of this name; -1: there is none.
  int open(std::string_view name);

 private:
  int folder_;
  std::map<std::string, Descriptor, std::less<>> opened_;
};

/// The names of the folders of all series.
std::vector<std::string> series_folder_names();

}  // namespace carom
