// Only the runs of the chosen scenarios are read. Scenarios with equal instants share one column of times.
#include "compare/series.h"

#include <fmt/format.h>

#include <iterator>

#include "compare/end_of_trajectory.h"
#include "files/stored_file.h"
#include "run/stored_trajectory.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

/// Bytes. A longer file is not read for a chart of 2,000 points.
constexpr uint64_t longest_file = 64 << 20;

constexpr double no_value = numeric_limits<double>::quiet_NaN();

bool is_short(const RunRecord& run, const char* name) {
  const optional<string> file = stored_table(run.folder.get(), name);
  if (!file || stored_size(run.folder.get(), *file).value_or(longest_file + 1) > longest_file) return false;
  if (*file == name) return true;
  // The bytes of a compressed one count when it is unpacked, so that charts do not depend on how tables are written.
  const Descriptor unpacked = open_stored_table(run.folder.get(), name);
  return file_size(unpacked.get()) <= longest_file;
}

SeriesGroup read_energy(const RunRecord& run) {
  SeriesGroup group;
  StoredTable table = open_table(run, "energy.csv");
  for (const char* name : {"kinetic_J", "total_J"})
    if (table.find(name)) group.columns.push_back({0, name, {}});
  while (table.next() != nullptr) {
    group.times.push_back(number_in(table.cell(0)).value_or(0));
    for (SeriesColumn& column : group.columns)
      column.values.push_back(number_in(table.cell(table.find(column.name))).value_or(no_value));
  }
  return group;
}

SeriesGroup read_bodies(const RunRecord& run, const vector<Measure>& measures) {
  SeriesGroup group;
  for (const Measure& measure : measures) group.columns.push_back({0, measure.name, {}});

  StoredTable table = open_table(run, "trajectory.csv");
  const TrajectoryLayout layout(table);
  string time;
  Vec3 position, velocity;

  while (const auto* cells = table.next()) {
    if (cells->front() != time) {
      time = cells->front();
      group.times.push_back(number_in(time).value_or(0));
      for (SeriesColumn& column : group.columns) column.values.push_back(no_value);
    }

    layout.for_each(*cells, [&](string_view body, size_t first) {
      for (size_t k = 0; k < measures.size(); ++k)
        if (measures[k].body == body && read_motion(*cells, first, position, velocity))
          group.columns[k].values.back() = quantity_of(measures[k].quantity, position, velocity, 1);
    });
  }

  // The table may have rows of other bodies alone.
  std::erase_if(group.columns, [](const SeriesColumn& column) {
    return all_of(column.values, [](double value) { return std::isnan(value); });
  });
  if (group.columns.empty()) group.times.clear();
  return group;
}

/// Keeps at most `most` evenly spaced rows, including the first and the last.
void thin(SeriesGroup& group, size_t most) {
  const size_t rows = group.times.size();
  if (rows <= most) return;
  const auto chosen = [&](const vector<double>& all) {
    vector<double> some(most);
    for (size_t i = 0; i < most; ++i) some[i] = all[i * (rows - 1) / (most - 1)];
    return some;
  };
  group.times = chosen(group.times);
  for (SeriesColumn& column : group.columns) column.values = chosen(column.values);
}

}  // namespace

SeriesGatherer::SeriesGatherer(ChosenScenarios scenarios, const vector<Measure>& measures)
    : scenarios_(std::move(scenarios)) {
  // A trajectory has no masses, and so no kinetic energies.
  for (const Measure& measure : measures)
    if (measure.form == MeasureForm::at_end && measure.quantity != Quantity::kinetic && bodies_.size() < most_bodies)
      bodies_.push_back(measure);
}

void SeriesGatherer::add(size_t number, const RunRecord& run) {
  const uint32_t scenario = scenarios_.of_run[number];
  if (!run.done || scenario == ChosenScenarios::none) return;
  const bool energy = has_file(run, "energy.csv"), trajectory = has_file(run, "trajectory.csv");
  if (!energy && trajectory && bodies_.empty()) follow_first(run);
  const bool bodies = trajectory && !bodies_.empty();
  if ((energy && !is_short(run, "energy.csv")) || (bodies && !is_short(run, "trajectory.csv"))) {
    ++left_out_;
    return;
  }
  if (energy) take(scenario, read_energy(run));
  if (bodies) take(scenario, read_bodies(run, bodies_));
}

/// Without measures of bodies and without energies, follows the speeds of the first few bodies.
void SeriesGatherer::follow_first(const RunRecord& run) {
  constexpr size_t few = 3;
  for (const EndMotion& motion : end_of_trajectory(run.folder.get()).bodies) {
    if (bodies_.size() == few) break;
    Measure& measure = bodies_.emplace_back();
    measure.name = fmt::format("{}.{}", motion.body, name_of(Quantity::speed));
    measure.form = MeasureForm::at_end;
    measure.body = motion.body;
    measure.quantity = Quantity::speed;
  }
}

void SeriesGatherer::take(uint32_t scenario, SeriesGroup part) {
  thin(part, most_points);
  if (part.times.empty()) return;
  for (SeriesColumn& column : part.columns) column.scenario = scenario;

  // A repeat joins the mean of those before it.
  for (SeriesGroup& group : groups_) {
    const auto same = ranges::find_if(group.columns, [&](const SeriesColumn& column) {
      return column.scenario == scenario && column.name == part.columns.front().name;
    });
    if (same == group.columns.end()) continue;

    if (group.times != part.times) {
      ++left_out_;
      return;
    }
    for (size_t k = 0; k < part.columns.size(); ++k) {
      SeriesColumn& mean = *(same + ptrdiff_t(k));
      ++mean.runs;
      for (size_t i = 0; i < mean.values.size(); ++i)
        mean.values[i] += (part.columns[k].values[i] - mean.values[i]) / double(mean.runs);
    }
    return;
  }

  // Scenarios with the same instants share their column.
  auto group = ranges::find_if(groups_, [&](const auto& g) { return g.times == part.times; });
  if (group == groups_.end()) {
    groups_.push_back({part.times, {}});
    group = groups_.end() - 1;
  }
  std::move(part.columns.begin(), part.columns.end(), std::back_inserter(group->columns));
}

vector<PlacedSeries> write_series(Worksheet& sheet, const SeriesGatherer& series) {
  vector<PlacedSeries> placed;
  size_t rows = 0, column = 0;
  vector<NumberLook> looks;
  const auto look_at = [&](const vector<double>& values) {
    looks.emplace_back();
    for (const double value : values) looks.back().add(value);
  };

  // The heads leave room for the longest name.
  constexpr double least = 16;  // characters
  size_t longest = 0;
  for (const string& name : series.scenarios().names) longest = max(longest, letters_of(name));
  sheet.set_head_row(0, min<size_t>(2 + longest / size_t(least), 5));

  for (const SeriesGroup& group : series.groups()) {
    rows = max(rows, group.times.size());
    sheet.head(0, column, "time (s)");
    look_at(group.times);
    const size_t time_column = column++;

    for (const SeriesColumn& values : group.columns) {
      const string& scenario = series.scenarios().names[values.scenario];
      sheet.head(0, column, fmt::format("{}: {}", label_of(values.name), scenario));
      look_at(values.values);
      PlacedSeries& place =
          placed.emplace_back(PlacedSeries{scenario, values.name, time_column, column++, group.times.size()});

      for (const double value : values.values) {
        place.least = std::fmin(place.least, value);
        place.greatest = std::fmax(place.greatest, value);
      }
    }
  }

  if (placed.empty()) {
    sheet.text(0, 0, "No run has energy.csv or trajectory.csv.", CellStyle::note);
    return placed;
  }

  // The sheet is streamed, so that rows go across all groups.
  for (size_t row = 0; row < rows; ++row) {
    column = 0;
    for (const SeriesGroup& group : series.groups()) {
      if (row < group.times.size()) {
        sheet.number(row + 1, column, group.times[row], CellStyle::plain, &looks[column]);
        for (size_t k = 0; k < group.columns.size(); ++k)
          sheet.number(row + 1, column + 1 + k, group.columns[k].values[row], CellStyle::plain, &looks[column + 1 + k]);
      }
      column += 1 + group.columns.size();
    }
  }

  sheet.fit_table(least);
  sheet.freeze(1, 1);
  sheet.print_first_page();
  return placed;
}

}  // namespace carom
