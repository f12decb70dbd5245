#pragma once
// The subfolders of a run's folder that hold series of files, such as frames/.

#include "files/file_place.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

/// The output with a series that contains this name, relative to a run's folder: "frames/frame_00012.png". Null: none.
const OutputKind* series_of(string_view name);

/// The output that writes a file of this name. Null: none, or a name that the scene gives (a film's).
const OutputKind* output_of(string_view name);

/// Whether a file of this name depends on appearance: one of frames/, a film, or what another program draws.
bool is_picture(string_view name);

/// The location of a file of a run.
struct FileSpot {
  int folder = -1;  // -1: the folder is absent
  string name;      // in that folder
};

/// Opens the folder of each series on first use. Follows no link.
class SeriesFolders {
 public:
  /// `folder`: the run's folder. It must outlive this object.
  explicit SeriesFolders(int folder) : folder_(folder) {}
  /// `name`: as in the manifest.
  FileSpot spot(string_view name);
  /// The folder of this name. -1: absent.
  int open(string_view name);

 private:
  int folder_;
  map<string, Descriptor, std::less<>> opened_;
};

/// The names of all series' folders.
vector<string> series_folder_names();

}  // namespace carom
