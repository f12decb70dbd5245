// Feeds raw RGB pictures to ffmpeg, which converts them to limited-range BT.709.
// The flags of the conversion are fixed, so that the same pictures give the same bytes.
#include "export/film.h"

#include <charconv>

namespace carom {
namespace {

std::string decimal(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// The pictures are full-range sRGB. The film is limited-range Y'CbCr by BT.709 and is marked so.
std::string film_filter(Size size) {
  std::string filter =
      "scale=in_range=pc:out_range=tv:out_color_matrix=bt709:flags=accurate_rnd+full_chroma_int+bitexact";
  // Colour has half the resolution, so both sides must be even. An odd side repeats its last pixel.
  const int right = size.width % 2, bottom = size.height % 2;
  if (right || bottom) {
    filter = "pad=" + std::to_string(size.width + right) + ":" + std::to_string(size.height + bottom) +
             ",fillborders=right=" + std::to_string(right) + ":bottom=" + std::to_string(bottom) + ":mode=smear," +
             filter;
  }
  return filter;
}

}  // namespace

Film::Film(const FilePlace& place, const VideoOutput& video, FilmTools tools, const FilmPatience& patience)
    : video_(video), file_(place, video.file, std::move(tools), patience) {}

void Film::add(const Image& image) {
  const int width = video_.size.width, height = video_.size.height;
  if (image.width != width || image.height != height) file_.fail_with("a picture is of another size");
  if (!file_.started())
    file_.start(
        {"-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
         std::to_string(width) + "x" + std::to_string(height), "-framerate", decimal(video_.fps), "-i", "pipe:0"},
        {"-vf", film_filter(video_.size)}, video_.crf, true);
  file_.send(image.pixels.data(), image.pixels.size());
  ++frames_;
}

}  // namespace carom
