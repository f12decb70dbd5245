#pragma once
// The script from which gnuplot draws a plot.

#include "export/plot.h"
#include "std.h"

namespace carom {

/// gnuplot's `set terminal` must precede it.
string plot_script(const Plot& plot);

/// The colour of a series, "#D55E00", and gnuplot's number of its mark, for a legend elsewhere.
string plot_color(const PlotSeries& series);
int plot_mark(const PlotSeries& series);

}  // namespace carom
