// The colours of .mp4 are converted here, so that ffmpeg only encodes.
#include "export/film.h"

#include "export/yuv.h"
#include "scene/film_format.h"
#include "std.h"

namespace carom {

Film::Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience)
    : video_(video),
      file_(place, video.file, std::move(tools), patience),
      pictures_([this](const RawPicture& picture) { file_.send(picture.data(), picture.size()); }, 0) {}

void Film::add(const Image& image) {
  if (image.width != video_.size.width || image.height != video_.size.height || !image.is_whole())
    file_.fail_with("a picture is of another size");

  if (!file_.started()) {
    encoding_ = film_encoding(video_, image);
    file_.start(encoding_.runs.front(), true);
  }

  RawPicture& picture = pictures_.item();
  if (film_format(video_.file) == FilmFormat::mp4)
    to_yuv420p(image, picture);
  else
    picture.assign(image.pixels.begin(), image.pixels.end());
  pictures_.send();
  ++frames_;
}

void Film::open_sound(const World& world, const FilmClock& clock, double lead, double length) {
  samples_.emplace(file_.workshop(), samples_file);
  sound_.emplace(world, clock, lead, length, [this](span<const float> samples) {
    samples_->write({reinterpret_cast<const char*>(samples.data()), samples.size_bytes()});
  });
}

void Film::record(span<const Collision> collisions) {
  if (sound_) sound_->record(collisions);
}

void Film::record_paths(span<const PathPiece> pieces) {
  if (sound_) sound_->record_paths(pieces);
}

void Film::complete() {
  pictures_.finish();
  if (sound_) {
    sound_->finish(double(frames_) / video_.fps);
    samples_->publish();
    encoding_.runs.push_back(sound_run(SoundTrack::rate, sound_->gain()));
  }

  for (size_t run = 1; run < encoding_.runs.size(); ++run) {
    file_.end_run();
    file_.start(encoding_.runs[run], false);
  }
  file_.complete(encoding_.file, frames_, video_.fps);
}

}  // namespace carom
