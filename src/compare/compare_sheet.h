#pragma once
// The first sheet of the workbook: charts, and beneath them their numbers.

#include "compare/charts.h"
#include "compare/parameter_sheet.h"
#include "compare/series.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

class CompareSheet {
 public:
  explicit CompareSheet(Workbook& book, bool streamed) : book_(book), sheet_(book.add("Compare", streamed)) {}

  /// `line`: the text above the charts. `differences`: a list below it. `series`: their places on the sheet Series, of
  /// so many scenarios.
  void write(const ComparisonPlan& plan, const string& line, const DifferenceList& differences,
             const vector<ChartData>& charts, const vector<PlacedSeries>& series, size_t scenarios);

 private:
  void write_differences(const ComparisonPlan& plan, const DifferenceList& differences);
  void write_data(const ChartData& chart, size_t first_row);
  void draw(const ChartData& data, size_t number, size_t first_row);
  void draw_over_time(const vector<PlacedSeries>& series, size_t number, size_t scenarios);
  void set_pages(size_t charts, size_t last_row);
  void place(lxw_chart* chart, size_t number);

  Workbook& book_;
  Worksheet& sheet_;
  size_t charts_row_ = 0;
};

}  // namespace carom
