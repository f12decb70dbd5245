#pragma once
// The first sheet of the workbook: what varied, the best and worst runs, which parameter matters, and charts.

#include "compare/findings.h"
#include "compare/heat_map.h"
#include "compare/parameter_sheet.h"
#include "compare/pivot_sheet.h"
#include "compare/sheet_charts.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

/// What the sheet shows.
struct FrontPage {
  const ComparisonPlan& plan;
  const vector<Measure>& measures;
  const Outcomes& outcomes;
  const Findings& findings;
  vector<string> lines;  // below the title
  const DifferenceList& differences;
  optional<pair<size_t, size_t>> heat_map;  // its parameters; none: charts alone
  SummaryPlace summary;
  /// Their places on the sheet Series, and of how many scenarios they are.
  const vector<PlacedSeries>& series;
  size_t scenarios = 0;
};

class CompareSheet {
 public:
  explicit CompareSheet(Workbook& book) : sheet_(book.add("Compare")) {}

  void write(const FrontPage& page, SheetCharts& charts);

 private:
  void write_differences(const FrontPage& page);
  void write_answers(const FrontPage& page);
  void write_ranking(const FrontPage& page, const MeasureFinding& finding, size_t first_column);
  void write_map(const FrontPage& page, const HeatMap& map, size_t measure);
  void write_block(const FrontPage& page, const MeasureFinding& finding, vector<ChartData>& left, SheetCharts& charts);
  void begin_page(size_t rows);

  Worksheet& sheet_;
  size_t row_ = 0;               // the next free one
  size_t page_ = 0, extra_ = 0;  // the first row of the present page; heights beyond one row on it
  vector<size_t> breaks_;
  vector<NumberLook> looks_;  // of parameters' values, by Findings::parameters
};

}  // namespace carom
