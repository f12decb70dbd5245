#include "scene/film_format.h"

#include <cmath>

namespace carom {

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
  return hundredths >= 2 && hundredths <= 65535 && std::abs(fps * hundredths - 100) <= 1e-3;
}

}  // namespace carom
