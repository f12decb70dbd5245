#pragma once
// Plots drawn by gnuplot, from a script that fixes every colour, font and range. The same plot gives the same bytes.

#include "export/plot.h"
#include "std.h"

namespace carom {

/// The absolute path of gnuplot. Throws ExportError with a text that names the remedy.
string find_gnuplot();

/// The complete files.
struct PlotPictures {
  string png, svg;
};

/// The pictures of each plot. Throws ExportError.
vector<PlotPictures> draw_plots(span<const Plot> plots, const string& gnuplot);

/// The SVG of each plot, drawn by one gnuplot. Throws ExportError.
vector<string> draw_svgs(span<const Plot> plots, const string& gnuplot);

}  // namespace carom
