#pragma once
// Films that are to be compared, by one camera.

#include "export/side_by_side.h"
#include "files/file_place.h"
#include "std.h"

namespace carom {

/// Where the cameras of all films frame the motion, and do so from different places, each film is drawn again by one
/// camera that sees what each of them sees. Films of other cameras stay as they are.
class CommonFilms {
 public:
  /// The tiles then name the new films, which lie in a folder of their own in `place` as long as this object lives.
  /// `stop_check` is called often, and may throw. Throws ExportError, RenderError, SimulationError.
  CommonFilms(const FilePlace& place, vector<FilmTile>& tiles, const function<void()>& stop_check);
  ~CommonFilms();
  CommonFilms(const CommonFilms&) = delete;
  CommonFilms& operator=(const CommonFilms&) = delete;

 private:
  FilePlace place_;
  vector<string> folders_;  // in `place`
};

}  // namespace carom
