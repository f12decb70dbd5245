#pragma once
// The range, the ticks and the label of an axis of a plot. gnuplot chooses none of these, so that they are the same in
// all its versions.

#include "export/plot.h"
#include "std.h"

namespace carom {

struct PlotTick {
  double at;
  string text;
};

struct PlotAxis {
  double from = 0, to = 1;  // below `to`
  /// Empty: one at each power of ten, by gnuplot.
  vector<PlotTick> ticks{};
  /// The ticks' texts are of values divided by 10^exponent.
  int exponent = 0;
  bool logarithmic = false;

  /// The share of the axis below a value.
  double part(double value) const;
  /// The commands of gnuplot for the axis 'x' or 'y'.
  string commands(char axis) const;
  /// The letters of the longest tick.
  size_t tick_letters() const;
  /// "height (10⁻⁶ m)". `unit`: empty for an axis whose label has it already.
  string label(const string& what, const string& unit) const;
};

/// Whole powers of ten with some margin around positive values.
PlotAxis log_axis(double low, double high);

/// From `low` to `high`, with about `most_ticks` ticks or fewer, at round values not closer than `least_step`.
/// Equal ends, or such up to rounding, are moved apart.
PlotAxis linear_axis(double low, double high, int most_ticks, double least_step = 0);

/// The axes that show all of a plot.
struct PlotAxes {
  PlotAxis x, y;
};
PlotAxes axes_of(const Plot& plot);

/// The smallest of 1, 2 and 5 times powers of ten that is not below `least`, which is positive: digit * 10^power.
struct RoundStep {
  int digit, power;
  double value() const;
};
RoundStep round_step(double least);

}  // namespace carom
