// A table is read once, row by row. Paths are followed by the replay, as pictures are.
#include "run/stored_charts.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "export/tables.h"
#include "files/open_folder.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "run/stored_trajectory.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

/// What a chart is made from.
struct ChartSource {
  string_view chart, table, key;
  /// Whether flights suffice too.
  bool follows_paths;
};
constexpr ChartSource chart_sources[] = {{"energy", "energy.csv", "energy", true},
                                         {"heights", "trajectory.csv", "trajectory", true},
                                         {"speeds", "trajectory.csv", "trajectory", true},
                                         {"collisions", "collisions.csv", "collisions", false}};

/// Rows between two calls of the watch.
constexpr uint64_t rows_between = 1000;

class ChartReader {
 public:
  ChartReader(const FormerRun& former, const Scene& scene, RunCharts& charts, const ReadingWatch& watch)
      : former_(former), scene_(scene), charts_(charts), watch_(watch) {}

  void go() {
    if (former_.has("collisions.csv")) collisions();
    ++parts_done_;
    if (former_.has_flights()) return paths();
    if (former_.has("energy.csv")) energy();
    ++parts_done_;
    if (former_.has("trajectory.csv")) trajectory();
  }

 private:
  void paths() {
    const unique_ptr<Simulator> motion = former_.motion(scene_);
    Timeline timeline(end_of(scene_));
    for (const Ticks& ticks : {charts_.ticks.energy, charts_.ticks.heights}) timeline.add(ticks);
    while (timeline.advance()) {
      do {
        watch_(share(motion->time()));
        motion->advance_to(timeline.time());
      } while (motion->time() < timeline.time());
      charts_.sample(timeline.time(), motion->state());
    }
  }

  /// The part that is done at a time of one of at most three files.
  double share(double time) const {
    const double duration = end_of(scene_);
    return (parts_done_ + (duration > 0 ? std::min(time / duration, 1.0) : 0)) / 3;
  }

  void energy() {
    StoredTable table = open("energy.csv");
    const size_t time = column(table, "time_s"), kinetic = column(table, "kinetic_J"),
                 potential = column(table, "potential_J");
    while (const auto* row = table.next()) {
      watch_now_and_then(number(*row, time));
      charts_.energy.add(number(*row, time), number(*row, kinetic), number(*row, potential));
    }
  }

  void trajectory() {
    StoredTrajectory trajectory(file("trajectory.csv"), scene_);
    while (trajectory.next()) {
      watch_(share(trajectory.time()));
      charts_.heights.add(trajectory.time(), trajectory.heights());
      for (size_t body = 0; body < trajectory.velocities().size(); ++body)
        if (std::isfinite(trajectory.heights()[body]))
          charts_.speeds.add(scene_.world.mass[body], trajectory.velocities()[body]);
    }
  }

  void collisions() {
    StoredTable table = open("collisions.csv");
    const size_t time = column(table, "time_s"), kind = column(table, "kind");
    while (const auto* row = table.next()) {
      watch_now_and_then(number(*row, time));
      if (const auto known = collision_kind_named(cell(*row, kind))) charts_.collisions.add(number(*row, time), *known);
    }
  }

  Descriptor file(const char* name) const {
    const Descriptor folder = open_folder(AT_FDCWD, former_.folder, true);
    Descriptor opened = folder ? open_stored(folder.get(), name) : Descriptor();
    if (!opened) throw ExportError(fmt::format("{}/{} is missing", former_.folder, name));
    return opened;
  }
  StoredTable open(const char* name) const { return StoredTable(file(name)); }

  static size_t column(const StoredTable& table, string_view name) {
    const auto found = table.find(name);
    if (!found) throw ExportError(fmt::format("a table has no column {}", name));
    return *found;
  }

  void watch_now_and_then(double time) {
    if (rows_++ % rows_between == 0) watch_(share(time));
  }

  static string_view cell(const vector<string_view>& row, size_t column) {
    return column < row.size() ? row[column] : string_view();
  }
  static double number(const vector<string_view>& row, size_t column) {
    const auto value = number_in(cell(row, column));
    if (!value) throw ExportError(fmt::format("a table has {} where a number is expected", cell(row, column)));
    return *value;
  }

  const FormerRun& former_;
  const Scene& scene_;
  RunCharts& charts_;
  const ReadingWatch& watch_;
  double parts_done_ = 0;
  uint64_t rows_ = 0;
};

}  // namespace

PossibleCharts possible_charts(const FormerRun& former) {
  PossibleCharts charts;
  for (const ChartSource& source : chart_sources) {
    if (former.has(source.table) || (source.follows_paths && former.has_flights()))
      charts.names.push_back(source.chart);
    else
      charts.missing.push_back({string(source.chart), fmt::format("the run has no {}, which the key output.{} gives",
                                                                  source.table, source.key)});
  }
  return charts;
}

bool is_drawn_by(const PossibleCharts& charts, string_view file) {
  const size_t slash = file.find('/');
  if (slash == string_view::npos || file.substr(0, slash) != plot_files.folder) return false;
  const string_view name = file.substr(slash + 1, file.rfind('.') - slash - 1);
  return std::ranges::find(charts.names, name) != charts.names.end();
}

void read_charts(const FormerRun& former, const Scene& scene, RunCharts& charts, const ReadingWatch& watch) {
  ChartReader(former, scene, charts, watch).go();
}

}  // namespace carom
