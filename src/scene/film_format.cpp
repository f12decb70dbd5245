#include "scene/film_format.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// Hundredths of a second for which a GIF shows a picture.
constexpr double least_hundredths = 2, most_hundredths = 65535;

}  // namespace

std::optional<FilmFormat> film_format(std::string_view file) {
  if (file.ends_with(".mp4")) return FilmFormat::mp4;
  if (file.ends_with(".gif")) return FilmFormat::gif;
  if (file.ends_with(".webp")) return FilmFormat::webp;
  return std::nullopt;
}

bool keeps_rate(FilmFormat format, double fps) {
  if (format != FilmFormat::gif) return true;
  // 100/3 has no decimal, so a rate need not be a double's exact quotient.
  const double hundredths = std::round(100 / fps);
  return hundredths >= least_hundredths && hundredths <= most_hundredths && std::abs(fps * hundredths - 100) <= 1e-3;
}

double gif_rate(double fps) {
  if (keeps_rate(FilmFormat::gif, fps)) return fps;
  return 100 / std::clamp(std::ceil(100 / fps), least_hundredths, most_hundredths);
}

}  // namespace carom
