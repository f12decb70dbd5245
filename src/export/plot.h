#pragma once
// Log-log plots, drawn by gnuplot from a script that fixes every colour, font and range.
// The same plot gives the same bytes.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace carom {

struct PlotPoint {
  double x, y;
  std::string label{};  // beside the point; empty: none
  // The ends of a bar through the point. NaN: no bar.
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
};

/// The number of colours, each with a mark.
inline constexpr std::size_t plot_looks = 8;

struct PlotSeries {
  std::string name;               // in the legend
  std::size_t look;               // index of its colour and mark, below plot_looks
  std::vector<PlotPoint> points;  // joined by a line, in this order
};

/// A height to compare with.
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
  /// Smaller values, such as zero, which has no logarithm, are drawn at this height.
  double floor = 0;
};

/// The absolute path of gnuplot. Throws ExportError with a text that names the remedy.
std::string find_gnuplot();

/// The complete files.
struct PlotPictures {
  std::string png, svg;
};

/// Throws ExportError.
PlotPictures draw_plot(const Plot& plot, const std::string& gnuplot);

}  // namespace carom
