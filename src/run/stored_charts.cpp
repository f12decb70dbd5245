// A table is read once, row by row. Paths are followed by the replay, as pictures are.
#include "run/stored_charts.h"

#include <fcntl.h>
#include <fmt/format.h>

#include "export/tables.h"
#include "files/folder_writer.h"
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

/// The height of a body that has merged into another.
constexpr double merged = numeric_limits<double>::quiet_NaN();

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
    if (former_.has("trajectory.csv") && former_.in_table.empty()) trajectory();
  }

 private:
  void paths() {
    const unique_ptr<Simulator> motion = former_.replay(scene_);
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
    return (parts_done_ + (duration > 0 ? min(time / duration, 1.0) : 0)) / 3;
  }

  void energy() {
    StoredTable table = open("energy.csv");
    const size_t time = column(table, "time_s"), kinetic = column(table, "kinetic_J"),
                 potential = column(table, "potential_J");
    while (table.next() != nullptr) {
      watch_now_and_then(number(table, time));
      charts_.energy.add(number(table, time), number(table, kinetic), number(table, potential));
    }
  }

  void trajectory() {
    StoredTrajectory trajectory(file("trajectory.csv"), scene_);
    vector<double> heights(scene_.world.body_count());
    while (trajectory.next()) {
      watch_(share(trajectory.time()));

      // Heights alone are needed before the end, and reading numbers takes most of the time.
      const bool is_end = trajectory.time() >= end_of(scene_);
      ranges::fill(heights, merged);
      trajectory.read([&](Entity body, const vector<string_view>& row, size_t first) {
        heights[body] = number_in(row[first + 1]).value_or(merged);
        Vec3 position, velocity;
        if (is_end && read_motion(row, first, position, velocity))
          charts_.speeds.add(scene_.world.mass[body], velocity);
      });
      charts_.heights.add(trajectory.time(), heights);
    }
  }

  void collisions() {
    StoredTable table = open("collisions.csv");
    const size_t time = column(table, "time_s"), kind = column(table, "kind");
    while (table.next() != nullptr) {
      watch_now_and_then(number(table, time));
      if (const auto known = collision_kind_named(table.cell(kind)))
        charts_.collisions.add(number(table, time), *known);
    }
  }

  Descriptor file(const char* name) const {
    const Descriptor folder = open_folder(AT_FDCWD, former_.folder, true);
    Descriptor opened = folder ? open_stored_table(folder.get(), name) : Descriptor();
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

  static double number(const StoredTable& table, size_t column) {
    const auto value = number_in(table.cell(column));
    if (!value) throw ExportError(fmt::format("a table has {} where a number is expected", table.cell(column)));
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
  const string& some = former.in_table;
  for (const ChartSource& source : chart_sources) {
    if (source.key == "trajectory" && !some.empty() && former.has(source.table) && !former.has_flights()) {
      charts.missing.push_back({string(source.chart), fmt::format("the run's {} has rows of {} alone, by the key "
                                                                  "output.{}.on",
                                                                  source.table, some, source.key)});
      continue;
    }

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
  return contains(charts.names, name);
}

void read_charts(const FormerRun& former, const Scene& scene, RunCharts& charts, const ReadingWatch& watch) {
  ChartReader(former, scene, charts, watch).go();
}

}  // namespace carom
