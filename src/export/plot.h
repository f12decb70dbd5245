#pragma once
// What a plot shows.

#include "std.h"

namespace carom {

struct PlotPoint {
  double x, y;
  /// Beside the point. Empty: none.
  string label{};
  // The ends of a bar through the point, or of a band. NaN: no bar.
  double low = numeric_limits<double>::quiet_NaN(), high = low;

  void keep(auto& archive) { archive(x, y, label, low, high); }
};

/// The usual size of an SVG, to which letters are proportioned.
inline constexpr int plot_width = 800, plot_height = 500;

/// The number of colours, each with a mark.
inline constexpr size_t plot_styles = 8;

enum class PlotForm {
  marks,   // joined by a line
  points,  // marks alone
  line,
  dashes,  // a dashed line, under which another one shows
  band     // from `low` to `high`, filled
};

struct PlotSeries {
  string name;  // in the legend; empty: not there
  /// Index of its colour and mark, below plot_styles.
  size_t style;
  /// In this order.
  vector<PlotPoint> points;
  PlotForm form = PlotForm::marks;
  /// The share of white in its colour.
  double tint = 0;
};

/// A height to compare with.
struct PlotLevel {
  string name;  // in the legend
  double y;
};

enum class PlotScale { logarithmic, linear };

struct Plot {
  string title;
  /// Smaller, below the title. Empty: none.
  string subtitle;
  string x_label, y_label;
  /// The units of linear axes, for their labels. A power of ten stands before the unit where numbers are large or
  /// small.
  string x_unit{}, y_unit{};
  /// In the order of drawing, a later one above.
  vector<PlotSeries> series;
  vector<PlotLevel> levels{};
  /// Smaller values, such as zero, which has no logarithm, are drawn at this height.
  double floor = 0;
  PlotScale scale = PlotScale::logarithmic;  // of both axes
  /// The x axis of a linear plot includes these. NaN: the points alone determine it.
  double x_from = numeric_limits<double>::quiet_NaN(), x_to = x_from;
  /// The y axis of a linear plot begins at 0, for values that are not negative.
  bool from_zero = false;
  /// The y axis of a linear plot counts: its ticks are whole numbers.
  bool counts = false;
  /// The size of the SVG. The PNG has twice as many pixels each way.
  int svg_width = plot_width, svg_height = plot_height;
  /// Where a value is drawn: not below `floor` on a logarithmic axis.
  double height(double y) const { return scale == PlotScale::logarithmic && y < floor ? floor : y; }
};

}  // namespace carom
