#pragma once
// The formats of films, which the ending of a film's name chooses.

#include "scene/output.h"
#include "std.h"

namespace carom {

enum class FilmFormat : unsigned char { mp4, gif, webp };

/// By the ending: .mp4, .gif or .webp. None: another one.
optional<FilmFormat> film_format(string_view file);

/// "an MP4", "a GIF" or "a WebP".
string_view film_name(FilmFormat format);

/// Whether the format can show each picture for exactly 1/fps. A GIF stores whole hundredths of a second, at least 2:
/// shorter ones are shown as 10 by most viewers. The times of a WebP are rounded to 1/1000 s, which is accepted here.
bool keeps_rate(FilmFormat format, double fps);

/// The highest rate up to `fps`, in 1/s, that a GIF keeps: 25 for 30. A rate below all of them becomes the lowest one.
double gif_rate(double fps);

/// What a format and ffmpeg's encoder of it can hold.
struct FilmLimits {
  int longest_side;        // pixels
  double lowest_fps;       // 1/s
  double highest_fps;      // 1/s
  string_view why_of_fps;  // what the rates follow from
};

FilmLimits limits_of(FilmFormat format);

/// ffmpeg takes pictures of any format up to (width + 128) (height + 128) = 2^28 - 1: av_image_check_size2() of
/// libavutil counts 8 bytes a pixel and 128 more pixels a side, in 31 bits. Tried with ffmpeg 5.1.
bool fits_ffmpeg(const Size& size);

}  // namespace carom
