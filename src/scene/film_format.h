#pragma once
// The formats of films, which the ending of a film's name chooses.
#include <optional>
#include <string>
#include <string_view>

namespace carom {

enum class FilmFormat : unsigned char { mp4, gif, webp };

/// By the ending: .mp4, .gif or .webp. None: another one.
std::optional<FilmFormat> film_format(std::string_view file);

/// Whether the format can show each picture for exactly 1/fps. A GIF stores whole hundredths of a second, at least 2:
/// shorter ones are shown as 10 by most viewers. The times of a WebP are rounded to 1/1000 s, which is accepted here.
bool keeps_rate(FilmFormat format, double fps);

/// The highest rate up to `fps`, in 1/s, that a GIF keeps: 25 for 30. A rate below all of them becomes the lowest one.
double gif_rate(double fps);

}  // namespace carom
