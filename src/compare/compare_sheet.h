#pragma once
// The first sheet of the workbook: charts, and beneath them their numbers.
#include <string>
#include <vector>

#include "compare/charts.h"
#include "compare/series.h"
#include "compare/workbook.h"

namespace carom {

class CompareSheet {
 public:
  explicit CompareSheet(Workbook& book, bool streamed) : book_(book), sheet_(book.add("Compare", streamed)) {}

  /// `lines`: the text above the charts. `series`: their places on the sheet Series.
  void write(const std::string& title, const std::vector<std::string>& lines, const std::vector<ChartData>& charts,
             const std::vector<PlacedSeries>& series);

 private:
  void write_data(const std::vector<ChartData>& charts, std::size_t first_row);
  void draw(const ChartData& data, std::size_t number, std::size_t first_row, std::size_t first_column);
  void draw_over_time(const std::vector<PlacedSeries>& series, std::size_t number);
  void place(lxw_chart* chart, std::size_t number);

  Workbook& book_;
  Worksheet& sheet_;
  std::size_t charts_row_ = 0;
};

}  // namespace carom
