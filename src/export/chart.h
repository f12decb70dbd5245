#pragma once
// What all charts of a run have in common.

#include "export/plot.h"
#include "export/thinned_line.h"
#include "std.h"

namespace carom {

struct Scene;

/// Indices of plot styles by their colours.
namespace chart_color {
inline constexpr size_t vermillion = 0, orange = 1, blue = 3, purple = 4, sky = 5, black = 6;
}

/// A linear plot with the scene's title, without data.
Plot chart_of(const Scene& scene, string_view subtitle);

/// The same over the time of the run.
Plot chart_over_time(const Scene& scene, string_view subtitle);

/// A line of a chart with so many instants. If they are few each has a mark, which shows when the run was sampled.
PlotSeries chart_line(string_view name, size_t style, const ThinnedLine& line, uint64_t instants);

}  // namespace carom
