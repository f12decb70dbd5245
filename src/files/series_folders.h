#pragma once
// The subfolders of a run's folder that hold series of files, such as frames/.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.h"
#include "scene/output_kinds.h"

namespace carom {

/// The output with a series that contains this name, relative to a run's folder: "frames/frame_00012.png". Null: none.
const OutputKind* series_of(std::string_view name);

/// The output that writes a file of this name. Null: none, or a name that the scene gives (a film's).
const OutputKind* output_of(std::string_view name);

/// Whether a file of this name depends on appearance: one of frames/, a film, or what another program draws.
bool is_picture(std::string_view name);

/// The location of a file of a run.
struct FileSpot {
  int folder = -1;   // -1: the folder is absent
  std::string name;  // in that folder
};

/// Opens the folder of each series on first use. Follows no link.
class SeriesFolders {
 public:
  /// `folder`: the run's folder. It must outlive this object.
  explicit SeriesFolders(int folder) : folder_(folder) {}
  /// `name`: as in the manifest.
  FileSpot spot(std::string_view name);
  /// The folder of this name. -1: absent.
  int open(std::string_view name);

 private:
  int folder_;
  std::map<std::string, Descriptor, std::less<>> opened_;
};

/// The names of all series' folders.
std::vector<std::string> series_folder_names();

}  // namespace carom
