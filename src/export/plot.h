#pragma once
// Log-log plots, drawn by gnuplot from a script that names every colour, font and range: the same plot gives the same
// bytes.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace carom {

struct PlotPoint {
  double x, y;
  std::string label{};  // beside it; empty: none
  // The ends of a bar through it; NaN: it has none.
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
};

/// How many colours with a mark each there are.
inline constexpr std::size_t plot_looks = 8;

struct PlotSeries {
  std::string name;               // in the legend
  std::size_t look;               // its colour and mark, below plot_looks
  std::vector<PlotPoint> points;  // joined by a line, in this order
};

/// A height that others are held against.
struct PlotLevel {
  std::string name;  // in the legend
  double y;
};

struct Plot {
  std::string title;
  std::string subtitle;  // smaller, below the title; empty: none
  std::string x_label, y_label;
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels;
  double floor = 0;  // what is less than this (zero, say, which has no logarithm) stands at this height
};

/// The absolute path of gnuplot. Throws ExportError, which names the remedy.
std::string find_gnuplot();

/// Whole files.
struct PlotPictures {
  std::string png, svg;
};

/// Throws ExportError.
PlotPictures draw_plot(const Plot& plot, const std::string& gnuplot);

}  // namespace carom
