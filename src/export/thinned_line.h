#pragma once
// A line of any number of points, thinned to those that determine its picture.

#include "export/plot.h"
#include "std.h"

namespace carom {

/// In each of `columns` equal intervals of x only the first, the lowest, the highest and the last point stay.
/// M4 of Jugel, Jerzak, Hackenbroich & Markl, PVLDB 7 (2014) 797: a picture with a pixel for each column is the same.
class ThinnedLine {
 public:
  /// The number of columns, about one for each pixel of a chart's frame.
  static constexpr int columns = 500;

  ThinnedLine(double from, double to) : from_(from), to_(to) {}
  /// `x`: not below the previous one.
  void add(double x, double y);
  /// All points so far, by x.
  vector<PlotPoint> points() const;

  void keep(auto& archive) { archive(now_, open_, closed_); }

 private:
  struct Column {
    PlotPoint first, lowest, highest, last;

    void keep(auto& archive) { archive(first, lowest, highest, last); }
  };
  static void put(vector<PlotPoint>& points, const Column& column);

  double from_, to_;
  int now_ = -1;  // the column of `open_`; -1: none
  Column open_{};
  vector<PlotPoint> closed_;
};

/// The interval, 0 to count - 1, of count equal ones from `from` to `to` that holds x. Those outside count in the
/// nearest.
int interval_of(double x, double from, double to, int count);

}  // namespace carom
