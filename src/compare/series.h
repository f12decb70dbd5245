#pragma once
// Time series of a few scenarios, thinned to what charts can show. Those of repeats are their mean.

#include "compare/compared_run.h"
#include "compare/scenarios.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {

/// One column of values over time.
struct SeriesColumn {
  uint32_t scenario = 0;
  string name;            // "kinetic_J", "balls.red.speed_m_per_s"
  vector<double> values;  // the mean of its runs
  size_t runs = 1;
};

/// Columns with the same instants.
struct SeriesGroup {
  vector<double> times;  // s
  vector<SeriesColumn> columns;
};

class SeriesGatherer {
 public:
  static constexpr size_t most_points = 250;  // of a run
  static constexpr size_t most_bodies = 24;

  /// For these scenarios. The bodies of `measures` are followed over time.
  SeriesGatherer(ChosenScenarios scenarios, const vector<Measure>& measures);
  /// Reads energy.csv and trajectory.csv of a run of a scenario, if they exist. `number`: of the run.
  void add(size_t number, const RunRecord& run);

  const ChosenScenarios& scenarios() const { return scenarios_; }
  const vector<SeriesGroup>& groups() const { return groups_; }
  /// The number of runs of the scenarios with files that are too long, or with other instants than the repeats before.
  size_t left_out() const { return left_out_; }

 private:
  void follow_first(const RunRecord& run);
  void take(uint32_t scenario, SeriesGroup part);

  ChosenScenarios scenarios_;
  vector<Measure> bodies_;
  size_t left_out_ = 0;
  vector<SeriesGroup> groups_;
};

/// The place of a column of values and its times on the sheet.
struct PlacedSeries {
  string scenario, name;
  size_t time_column, value_column, rows;  // the first row is 1
  double least = numeric_limits<double>::quiet_NaN(), greatest = least;
};

/// Writes the sheet: a column of times for each group, then its columns, "kinetic energy (J): restitution = 0.5".
vector<PlacedSeries> write_series(Worksheet& sheet, const SeriesGatherer& series);

}  // namespace carom
