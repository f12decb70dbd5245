#pragma once
// The parts of a film: a title card before its pictures, and a chart beside them.

#include "scene/output.h"
#include "std.h"

namespace carom {

/// How long (s of film) a title card is shown.
inline constexpr double title_length = 2;

/// The pictures of the film's title card: those of 2 s, rounded, at least one. 0: it has no card.
int64_t title_pictures(const VideoOutput& video);

/// A picture of the film, and a chart to its right, or below it if the film is less than 4/3 as wide as high. The chart
/// has about a third. Without a chart the picture has all of the film, and the chart's size is 0.
struct FilmLayout {
  Size picture, chart;    // pixels
  int left = 0, top = 0;  // pixels, of the chart
};
FilmLayout layout_of(const VideoOutput& video);

/// The least size of a film with a chart, in which its text can be read.
inline constexpr Size least_with_chart = {320, 180};

}  // namespace carom
