#pragma once
// Time series of many runs, thinned to what a spreadsheet and its charts can hold.
#include <cstddef>
#include <string>
#include <vector>

#include "compare/compared_run.h"
#include "compare/workbook.h"

namespace carom {

/// One column of values over time.
struct SeriesColumn {
  std::string run;   // id of the run
  std::string name;  // "kinetic_J", "balls.red.speed_m_per_s"
  std::vector<double> values;
};

/// Columns with the same instants.
struct SeriesGroup {
  std::vector<double> times;  // s
  std::vector<SeriesColumn> columns;
};

class SeriesGatherer {
 public:
  static constexpr std::size_t most_points = 2000;  // of a run
  static constexpr std::size_t most_cells = 250'000, most_columns = 4000;

  /// For `runs` runs. The bodies of `measures` are followed over time.
  SeriesGatherer(std::size_t runs, const std::vector<Measure>& measures);
  /// Reads energy.csv and trajectory.csv of a run, if they exist and there is room.
  void add(const RunRecord& run);

  const std::vector<SeriesGroup>& groups() const { return groups_; }
  std::size_t points() const { return points_; }  // maximum for each run
  /// The number of runs without room, or with files that are too long.
  std::size_t left_out() const { return left_out_; }

 private:
  void follow_first(const RunRecord& run);
  void take(const std::string& run, SeriesGroup part);

  std::vector<Measure> bodies_;
  std::size_t points_, cells_ = 0, columns_ = 0, left_out_ = 0;
  std::vector<SeriesGroup> groups_;
};

/// The place of a column of values and its times on the sheet.
struct PlacedSeries {
  std::string run, name;
  std::size_t time_column, value_column, rows;  // the first row is 1
};

/// Writes the sheet: a column of times for each group, then its columns, "r0001.kinetic_J".
std::vector<PlacedSeries> write_series(Worksheet& sheet, const SeriesGatherer& series);

}  // namespace carom
