// Thins the series of each run to a common limit, which depends on the number of runs and columns.
// Runs with equal instants share one column of times.
#include "compare/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "files/stored_file.h"
#include "run/stored_trajectory.h"

namespace carom {
namespace {

constexpr std::size_t fewest_points = 100;
/// Bytes. A longer file is not read for a chart of 2,000 points.
constexpr std::uint64_t longest_file = 64 << 20;

bool is_short(const RunRecord& run, const char* name) {
  const auto size = stored_size(run.folder.get(), name);
  return size && *size <= longest_file;
}

SeriesGroup read_energy(const RunRecord& run) {
  SeriesGroup group;
  StoredTable table = open_table(run, "energy.csv");
  std::vector<std::size_t> from;
  for (const char* name : {"kinetic_J", "total_J"}) {
    const auto column = table.find(name);
    if (!column) continue;
    from.push_back(*column);
    group.columns.push_back({run.run.id, name, {}});
  }
  while (const auto* cells = table.next()) {
    group.times.push_back(number_in((*cells)[0]).value_or(0));
    for (std::size_t k = 0; k < from.size(); ++k)
      group.columns[k].values.push_back(from[k] < cells->size() ? number_in((*cells)[from[k]]).value_or(std::nan(""))
                                                                : std::nan(""));
  }
  return group;
}

SeriesGroup read_bodies(const RunRecord& run, const std::vector<Measure>& measures) {
  SeriesGroup group;
  StoredTable table = open_table(run, "trajectory.csv");
  std::vector<std::string> bodies;
  for (const Measure& measure : measures) {
    bodies.push_back(measure.body);
    group.columns.push_back({run.run.id, measure.name, {}});
  }
  const MotionColumns columns = motion_columns(table, bodies);
  std::string time;
  Vec3 position, velocity;
  while (const auto* cells = table.next()) {
    if (columns.wide || (*cells)[0] != time) {
      time = (*cells)[0];
      group.times.push_back(number_in(time).value_or(0));
      for (SeriesColumn& column : group.columns) column.values.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t k = 0; k < measures.size(); ++k) {
      if (!columns.wide && (cells->size() <= columns.body || (*cells)[columns.body] != measures[k].body)) continue;
      const std::size_t first = columns.wide ? columns.first[k] : columns.body + 1;
      if (first > 0 && read_motion(*cells, first, position, velocity))
        group.columns[k].values.back() = quantity_of(measures[k].quantity, position, velocity, 1);
    }
  }
  return group;
}

/// Keeps at most `most` evenly spaced rows, including the first and the last.
void thin(SeriesGroup& group, std::size_t most) {
  const std::size_t rows = group.times.size();
  if (rows <= most) return;
  const auto chosen = [&](const std::vector<double>& all) {
    std::vector<double> some(most);
    for (std::size_t i = 0; i < most; ++i) some[i] = all[i * (rows - 1) / (most - 1)];
    return some;
  };
  group.times = chosen(group.times);
  for (SeriesColumn& column : group.columns) column.values = chosen(column.values);
}

}  // namespace

SeriesGatherer::SeriesGatherer(std::size_t runs, const std::vector<Measure>& measures) {
  // A trajectory has no masses, and so no kinetic energies.
  for (const Measure& measure : measures)
    if (measure.form == MeasureForm::at_end && measure.quantity != Quantity::kinetic) bodies_.push_back(measure);
  const std::size_t columns = 2 + bodies_.size();
  points_ = std::clamp(most_cells / std::max<std::size_t>(1, columns * runs), fewest_points, most_points);
}

void SeriesGatherer::add(const RunRecord& run) {
  if (!run.done) return;
  const bool energy = has_file(run, "energy.csv"), trajectory = has_file(run, "trajectory.csv");
  if (!energy && trajectory && bodies_.empty()) follow_first(run);
  const bool bodies = trajectory && !bodies_.empty();
  if (!energy && !bodies) return;
  const std::size_t columns = (energy ? 2 : 0) + (bodies ? bodies_.size() : 0) + 2;
  const bool room = cells_ < most_cells && columns_ + columns <= most_columns;
  if (!room || (energy && !is_short(run, "energy.csv")) || (bodies && !is_short(run, "trajectory.csv"))) {
    ++left_out_;
    return;
  }
  if (energy) take(run.run.id, read_energy(run));
  if (bodies) take(run.run.id, read_bodies(run, bodies_));
}

/// Without measures of bodies and without energies, follows the speeds of the first few bodies.
void SeriesGatherer::follow_first(const RunRecord& run) {
  constexpr std::size_t few = 3;
  for (const EndMotion& motion : end_of_trajectory(run.folder.get())) {
    if (bodies_.size() == few) break;
    Measure& measure = bodies_.emplace_back();
    measure.name = fmt::format("{}.{}", motion.body, name_of(Quantity::speed));
    measure.form = MeasureForm::at_end;
    measure.body = motion.body;
    measure.quantity = Quantity::speed;
  }
}

void SeriesGatherer::take(const std::string& run, SeriesGroup part) {
  thin(part, points_);
  if (part.times.empty()) return;
  auto group = std::find_if(groups_.begin(), groups_.end(), [&](const auto& g) { return g.times == part.times; });
  if (group == groups_.end()) {
    groups_.push_back({part.times, {}});
    group = groups_.end() - 1;
    ++columns_;
    cells_ += part.times.size();
  }
  for (SeriesColumn& column : part.columns) {
    ++columns_;
    cells_ += column.values.size();
    group->columns.push_back({run, std::move(column.name), std::move(column.values)});
  }
}

std::vector<PlacedSeries> write_series(Worksheet& sheet, const SeriesGatherer& series) {
  std::vector<PlacedSeries> placed;
  std::size_t rows = 0, column = 0;
  for (const SeriesGroup& group : series.groups()) {
    rows = std::max(rows, group.times.size());
    sheet.text(0, column, "time_s", CellStyle::header);
    const std::size_t time_column = column++;
    for (const SeriesColumn& values : group.columns) {
      sheet.text(0, column, fmt::format("{}.{}", values.run, values.name), CellStyle::header);
      placed.push_back({values.run, values.name, time_column, column++, group.times.size()});
    }
  }
  if (placed.empty()) {
    sheet.text(0, 0, "No run has energy.csv or trajectory.csv.", CellStyle::note);
    return placed;
  }
  for (std::size_t row = 0; row < rows; ++row) {
    column = 0;
    for (const SeriesGroup& group : series.groups()) {
      if (row < group.times.size()) {
        sheet.number(row + 1, column, group.times[row]);
        for (std::size_t k = 0; k < group.columns.size(); ++k)
          sheet.number(row + 1, column + 1 + k, group.columns[k].values[row]);
      }
      column += 1 + group.columns.size();
    }
  }
  sheet.fit_all(10, 40);
  sheet.freeze(1, 1);
  sheet.print_table();
  return placed;
}

}  // namespace carom
