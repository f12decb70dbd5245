#pragma once
// A film while ffmpeg writes it, in a folder of its own beside the film's place, until it is whole.
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/child.h"
#include "files/output_file.h"

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

class FilmFile : public PartFile {
 public:
  /// Throws ExportError, as all of this class does.
  FilmFile(const FilePlace& place, const std::string& name, FilmTools tools, const FilmPatience& patience);
  /// ffmpeg is stopped, and its folder goes.
  ~FilmFile();

  /// ffmpeg's own folder; made by the first call.
  FilePlace workshop();
  /// Starts ffmpeg there: `input` says what comes, `filter` (an option and its value) what is done to it. The rest,
  /// H.264 in yuv420p and BT.709, index in front, the same pictures the same bytes, is every film's.
  void start(const std::vector<std::string>& input, const std::vector<std::string>& filter, int crf, bool fed);
  bool started() const { return ffmpeg_ != nullptr; }
  void send(const void* bytes, std::size_t size);

  /// Waits for ffmpeg's end and counts the frames in the film: ffmpeg may end content with half of them. The film is
  /// the part that publish() names.
  void complete(std::uint64_t frames);

  [[noreturn]] void fail_with(const std::string& reason) const;

 private:
  std::string workshop_name() const;

  FilmTools tools_;
  FilmPatience patience_;
  Descriptor workshop_;
  std::unique_ptr<Child> ffmpeg_;
};

/// What there is to know of a stored film.
struct FilmFacts {
  int width = 0, height = 0;        // pixels
  std::uint64_t rate = 0, per = 1;  // frames a second: rate / per
  std::uint64_t frames = 0;
};
/// Asks ffprobe. Throws ExportError.
FilmFacts film_facts(const FilmTools& tools, const FilePlace& place, const std::string& name);

}  // namespace carom
