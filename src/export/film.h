#pragma once
// animation.mp4. Raw pictures go to ffmpeg as they are drawn, without intermediate files.
#include <cstdint>

#include "export/film_file.h"
#include "render/image.h"
#include "scene/output.h"

namespace carom {

/// H.264, yuv420p, BT.709, index in front. Frame i is shown at i / fps. The same pictures give the same bytes.
class Film {
 public:
  Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience = {});

  /// Throws ExportError, as all functions of this class do.
  void add(const Image& image);
  std::uint64_t frames() const { return frames_; }

  /// Waits for ffmpeg and verifies the number of frames in the film.
  void complete() { file_.complete(frames_); }
  PartFile& file() { return file_; }
  const FileRecord& record() const { return file_.record(); }  // valid after complete()

 private:
  VideoOutput video_;
  FilmFile file_;
  std::uint64_t frames_ = 0;
};

}  // namespace carom
