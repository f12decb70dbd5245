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
  /// Beside the point. Empty: none.
  std::string label{};
  // The ends of a bar through the point. NaN: no bar.
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
};

/// The number of colours, each with a mark.
inline constexpr std::size_t plot_styles = 8;

struct PlotSeries {
  std::string name;  // in the legend
  /// Index of its colour and mark, below plot_styles.
  std::size_t style;
  /// Joined by a line, in this order.
  std::vector<PlotPoint> points;
};

/// A height to compare with.
struct PlotLevel {
  std::string name;  // in the legend
  double y;
};

struct Plot {
  std::string title;
  /// Smaller, below the title. Empty: none.
  std::string subtitle;
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
