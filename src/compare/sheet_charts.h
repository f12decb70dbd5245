#pragma once
// Charts that the spreadsheet draws, and the sheet Points with their numbers.

#include "compare/charts.h"
#include "compare/series.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

/// The place of a chart on a sheet: the cell of its corner, and its size in pixels.
struct ChartPlace {
  size_t row = 0, column = 0;
  double width = 0, height = 0;
};

class SheetCharts {
 public:
  /// Adds the sheet Points to `book`.
  SheetCharts(Workbook& book, bool streamed);

  /// Draws a chart on a sheet. One without points is left out.
  void draw(Worksheet& sheet, const ChartData& data, const ChartPlace& place);
  /// Draws the first quantity of the sheet Series over time, of a few of so many scenarios.
  void draw_over_time(Worksheet& sheet, const vector<PlacedSeries>& series, size_t scenarios, const ChartPlace& place);
  /// To be called after the last chart.
  void finish();

 private:
  size_t write_points(const ChartData& chart);

  Workbook& book_;
  Worksheet& points_;
  size_t row_ = 0;
};

}  // namespace carom
