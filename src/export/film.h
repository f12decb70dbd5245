#pragma once
// animation.mp4, or a film as GIF or WebP. Pictures go to ffmpeg as they are drawn, without files of their own.

#include "export/film_file.h"
#include "export/sound_track.h"
#include "files/conveyor.h"
#include "render/image.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// A film whose frame i is shown at i / fps. The same pictures give the same bytes.
/// ffmpeg encodes one frame while the caller draws the next ones: a thread of its own passes the pictures on.
class Film {
 public:
  Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience = {});
  ~Film() { file_.abandon(); }

  /// Copies the picture. Waits while 4 pictures are on their way.
  /// Throws ExportError, as all functions of this class do, also the error of an earlier picture.
  void add(const Image& image);
  uint64_t frames() const { return frames_; }

  /// Gives the film the sound of a motion of this world. length: s, of the film.
  void open_sound(const World& world, const FilmClock& clock, double lead, double length);
  /// Take what has been recorded since the last call, for the sound if there is one.
  void record(span<const Collision> collisions);
  void record_paths(span<const PathPiece> pieces);

  /// Waits for ffmpeg and verifies the number of frames in the film.
  void complete();
  PartFile& file() { return file_; }
  const FileRecord& record() const { return file_.record(); }  // valid after complete()

 private:
  using RawPicture = vector<uint8_t>;

  VideoOutput video_;
  FilmEncoding encoding_;  // known with the first picture
  FilmFile file_;
  uint64_t frames_ = 0;
  optional<OutputFile> samples_;  // of the sound
  optional<SoundTrack> sound_;
  Conveyor<RawPicture> pictures_;  // last, because its thread uses file_
};

}  // namespace carom
