#pragma once
// Plots, drawn by gnuplot from a script that fixes every colour, font and range.
// The same plot gives the same bytes.
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace carom {

struct PlotPoint {
  double x, y;
  /// Beside the point. Empty: none.
  std::string label{};
  // The ends of a bar through the point, or of a band. NaN: no bar.
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;

  void keep(auto& archive) { archive(x, y, label, low, high); }
};

/// The number of colours, each with a mark.
inline constexpr std::size_t plot_styles = 8;

enum class PlotForm {
  marks,  // joined by a line
  line,
  dashes,  // a dashed line, under which another one shows
  band     // from `low` to `high`, filled
};

struct PlotSeries {
  std::string name;  // in the legend; empty: not there
  /// Index of its colour and mark, below plot_styles.
  std::size_t style;
  /// In this order.
  std::vector<PlotPoint> points;
  PlotForm form = PlotForm::marks;
  /// The share of white in its colour.
  double tint = 0;
};

/// A height to compare with.
struct PlotLevel {
  std::string name;  // in the legend
  double y;
};

enum class PlotScale { logarithmic, linear };

struct Plot {
  std::string title;
  /// Smaller, below the title. Empty: none.
  std::string subtitle;
  std::string x_label, y_label;
  /// The units of linear axes, for their labels. A power of ten stands before the unit where numbers are large or
  /// small.
  std::string x_unit{}, y_unit{};
  /// In the order of drawing, a later one above.
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels{};
  /// Smaller values, such as zero, which has no logarithm, are drawn at this height.
  double floor = 0;
  PlotScale scale = PlotScale::logarithmic;  // of both axes
  /// The x axis of a linear plot includes these. NaN: the points alone determine it.
  double x_from = std::numeric_limits<double>::quiet_NaN(), x_to = x_from;
  /// The y axis of a linear plot begins at 0, for values that are not negative.
  bool from_zero = false;
  /// The y axis of a linear plot counts: its ticks are whole numbers.
  bool counts = false;
  /// Where a value is drawn: not below `floor` on a logarithmic axis.
  double height(double y) const { return scale == PlotScale::logarithmic && y < floor ? floor : y; }
};

/// The size of the SVG, to which letters are proportioned. The PNG has twice as many pixels each way.
inline constexpr int plot_width = 800, plot_height = 500;

/// The absolute path of gnuplot. Throws ExportError with a text that names the remedy.
std::string find_gnuplot();

/// The complete files.
struct PlotPictures {
  std::string png, svg;
};

/// The pictures of each plot. Throws ExportError.
std::vector<PlotPictures> draw_plots(std::span<const Plot> plots, const std::string& gnuplot);
PlotPictures draw_plot(const Plot& plot, const std::string& gnuplot);

}  // namespace carom
