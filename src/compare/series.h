#pragma once
// What changes over time in many runs, thinned so that a spreadsheet and its charts can hold it.
#include <cstddef>
#include <string>
#include <vector>

#include "compare/compared_run.h"
#include "compare/workbook.h"

namespace carom {

/// One column over time.
struct SeriesColumn {
  std::string run;   // its id
  std::string name;  // "kinetic_J", "balls.red.speed_m_per_s"
  std::vector<double> values;
};

/// Columns that share their instants.
struct SeriesGroup {
  std::vector<double> times;  // s
  std::vector<SeriesColumn> columns;
};

class SeriesGatherer {
 public:
  static constexpr std::size_t most_points = 2000;  // of a run
  static constexpr std::size_t most_cells = 250'000, most_columns = 4000;

  /// Of `runs` runs; the bodies of `measures` are followed over time.
  SeriesGatherer(std::size_t runs, const std::vector<Measure>& measures);
  /// Takes energy.csv and trajectory.csv of a run, as far as they are there and there is room.
  void add(const RunRecord& run);

  const std::vector<SeriesGroup>& groups() const { return groups_; }
  std::size_t points() const { return points_; }      // of a run, at most
  std::size_t left_out() const { return left_out_; }  // runs for which there was no room, or whose files are too long

 private:
  void follow_first(const RunRecord& run);
  void take(const std::string& run, SeriesGroup part);

  std::vector<Measure> bodies_;
  std::size_t points_, cells_ = 0, columns_ = 0, left_out_ = 0;
  std::vector<SeriesGroup> groups_;
};

/// Where a column of values and its times went on the sheet.
struct PlacedSeries {
  std::string run, name;
  std::size_t time_column, value_column, rows;  // first row: 1
};

/// The sheet: a column of times for each group, then its columns, "r0001.kinetic_J".
std::vector<PlacedSeries> write_series(Worksheet& sheet, const SeriesGatherer& series);

}  // namespace carom
