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

void Film::complete() {
  pictures_.finish();
  for (size_t run = 1; run < encoding_.runs.size(); ++run) {
    file_.end_run();
    file_.start(encoding_.runs[run], false);
  }
  file_.complete(encoding_.file, frames_, video_.fps);
}

}  // namespace carom
