#pragma once
// Series: numbered files of one output in a subfolder of the run's folder, such as frames/.

#include "files/file_place.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

/// The output with a series that contains this name, relative to a run's folder: "frames/frame_00012.png". Null: none.
const OutputKind* output_with_series(string_view name);

/// The output that writes a file of this name. Null: none, or a name that the scene gives (a film's).
const OutputKind* output_of(string_view name);

/// Whether a file of this name depends on colours, camera and their like: pictures, films, and what other programs
/// draw.
bool depends_on_look(string_view name);

/// The location of a file of a run.
struct FileSpot {
  int folder = -1;  // its descriptor; -1: it is absent
  string name;      // in that folder
};

/// Opens the folder of each series on first use. Follows no link.
class SeriesFolders {
 public:
  /// `folder`: the run's folder. It must outlive this object.
  explicit SeriesFolders(int folder) : folder_(folder) {}
  /// `name`: as in the manifest.
  FileSpot spot(string_view name);
  /// The descriptor of this name's folder, open as long as this object lives. -1: absent.
  int open(string_view name);

 private:
  int folder_;
  map<string, Descriptor, std::less<>> opened_;
};

/// The names of all series' folders.
vector<string> series_folder_names();

}  // namespace carom
