#pragma once
// A film that ffmpeg writes in a temporary folder beside the film's place until it is complete.
#include <chrono>

#include "export/child.h"
#include "export/film_encoding.h"
#include "files/output_file.h"
#include "std.h"

namespace carom {

/// The programs that make and inspect a film.
struct FilmTools {
  string ffmpeg, ffprobe;  // absolute paths
};

/// Finds them on PATH. Throws ExportError with a text that names the remedy.
FilmTools find_film_tools();

/// Time limits: how long ffmpeg may take no input, and how long it may run after the last input.
struct FilmPatience {
  std::chrono::milliseconds each = std::chrono::minutes(2);
  std::chrono::milliseconds end = std::chrono::minutes(10);
};

class FilmFile : public PartFile {
 public:
  /// Throws ExportError, as all functions of this class do.
  FilmFile(const FilePlace& place, const string& name, FilmTools tools, const FilmPatience& patience);
  /// Stops ffmpeg and removes its folder.
  ~FilmFile();

  /// The temporary folder of ffmpeg. The first call makes it.
  FilePlace workshop();
  /// Starts a run of ffmpeg there. `fed`: send() gives it its input.
  void start(const FfmpegRun& run, bool fed);
  bool started() const { return ffmpeg_ != nullptr; }
  /// May be called on another thread than the rest.
  void send(const void* bytes, size_t size);
  /// Ends a send() on another thread.
  void abandon();
  /// Waits for the end of the present run.
  void end_run();

  /// Ends the present run and verifies the number of frames, because ffmpeg may succeed with half of them.
  /// `made`: the film's name in the temporary folder. `fps`: its pictures a second.
  /// The film then has its temporary name, and publish() renames it.
  void complete(const string& made, uint64_t frames, double fps);

  [[noreturn]] void fail_with(const string& reason) const;

 private:
  string workshop_name() const;

  FilmTools tools_;
  FilmPatience patience_;
  Descriptor workshop_;
  unique_ptr<Child> ffmpeg_;
};

/// The properties of a stored film.
struct FilmFacts {
  int width = 0, height = 0;   // pixels
  uint64_t rate = 0, per = 1;  // frame rate in 1/s: rate / per
  uint64_t frames = 0;
};
/// Reads the properties with ffprobe. Throws ExportError.
FilmFacts film_facts(const FilmTools& tools, const FilePlace& place, const string& name);

}  // namespace carom
