#pragma once
// animation.mp4: raw pictures go to ffmpeg as they are drawn, none is written first.
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/child.h"
#include "export/output_file.h"
#include "render/image.h"
#include "scene/scene.h"

namespace carom {

/// The programs that make a film and look into it.
struct FilmTools {
  std::string ffmpeg, ffprobe;  // absolute paths
};

/// Finds them on PATH. Throws ExportError, which names the remedy.
FilmTools find_film_tools();

/// How long ffmpeg may take nothing, and how long it may take to end once it has everything.
struct FilmPatience {
  std::chrono::milliseconds each = std::chrono::minutes(2);
  std::chrono::milliseconds end = std::chrono::minutes(10);
};

/// H.264, yuv420p, BT.709, index in front; frame i stands at i / fps. The same pictures give the same bytes.
class Film {
 public:
  Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience = {});
  /// Without publish(): ffmpeg is stopped and nothing of the film stays.
  ~Film();

  void add(const Image& image);  // throws ExportError, as all of this class does
  std::uint64_t frames() const { return frames_; }

  /// Waits for ffmpeg and counts the frames in the film: ffmpeg may end content with half of them.
  void complete();
  void publish();
  const FileRecord& record() const { return record_; }  // after complete()

 private:
  void start();
  [[noreturn]] void fail_with(const std::string& reason);

  FilePlace place_;
  VideoOutput video_;
  FilmTools tools_;
  FilmPatience patience_;
  Descriptor workshop_;  // ffmpeg's own folder, from the first picture on
  std::unique_ptr<Child> ffmpeg_;
  std::uint64_t frames_ = 0;
  FileRecord record_;
  bool published_ = false;
};

}  // namespace carom
