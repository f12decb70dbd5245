#include "scene/film_format.h"

#include "std.h"

namespace carom {
namespace {

// Hundredths of a second for which a GIF shows a picture.
constexpr double least_hundredths = 2, most_hundredths = 65535;

}  // namespace

optional<FilmFormat> film_format(string_view file) {
  if (file.ends_with(".mp4")) return FilmFormat::mp4;
  if (file.ends_with(".gif")) return FilmFormat::gif;
  if (file.ends_with(".webp")) return FilmFormat::webp;
  return nullopt;
}

string_view film_name(FilmFormat format) {
  constexpr string_view names[] = {"an MP4", "a GIF", "a WebP"};
  return names[size_t(format)];
}

bool keeps_rate(FilmFormat format, double fps) {
  if (format != FilmFormat::gif) return true;
  // 100/3 has no decimal, so a rate need not be a double's exact quotient.
  const double hundredths = std::round(100 / fps);
  return hundredths >= least_hundredths && hundredths <= most_hundredths && std::abs(fps * hundredths - 100) <= 1e-3;
}

double gif_rate(double fps) {
  if (keeps_rate(FilmFormat::gif, fps)) return fps;
  return 100 / clamp(ceil(100 / fps), least_hundredths, most_hundredths);
}

// Measured with ffmpeg 5.1, libx264 164 and libwebp 1.2.4, 2 or 3 pictures each.
FilmLimits limits_of(FilmFormat format) {
  constexpr int any_side = 16384;
  switch (format) {
    case FilmFormat::gif:
      return {any_side, 100.0 / 65535, 50, "a GIF shows a picture for 2 to 65535 hundredths of a second"};
    case FilmFormat::webp:
      // The length is 24 bits, and a time that two pictures share leaves one of them out.
      return {16383, 6e-5, 1000, "a WebP shows a picture for 1 to 16777215 thousandths of a second"};
    case FilmFormat::mp4:
      break;
  }
  // The length is 31 bits, in units of at least 1/20000 s. ffmpeg rounds rates above 1001000.
  return {any_side, 1e-5, 1e6, "an MP4 shows a picture for a millionth of a second to 100000 s"};
}

bool fits_ffmpeg(const Size& size) {
  return (int64_t{size.width} + 128) * (int64_t{size.height} + 128) < int64_t{1} << 28;
}

}  // namespace carom
