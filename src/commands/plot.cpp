// Plans the folders as render does, then reads and draws each run. Charts without data are reported with the key that
// gives them; a run is never simulated for them.
#include "commands/commands.h"

#include <fmt/format.h>

#include <new>

#include "commands/batch.h"
#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/text.h"
#include "export/gnuplot.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "files/series_folders.h"
#include "run/plot_run.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

/// Settings by which the scene lists the run's tables, where it lists none or another interval (--only may add tables).
/// Charts of their rows are then those that the scene asks for.
vector<Setting> settings_of_tables(const Scene& scene, const FormerRun& former) {
  const PlotIntervals run = plot_intervals(former.scene.output), listed = plot_intervals(scene.output);
  vector<Setting> settings;
  if (former.has_flights()) return settings;
  const auto list = [&](const char* table, const optional<double>& every, const optional<double>& known) {
    if (every && every != known) settings.push_back({fmt::format("output.{}={{every: {}}}", table, *every), ""});
  };
  list("energy", run.energy, listed.energy);
  list("trajectory", run.trajectory, listed.trajectory);
  return settings;
}

class PlotPlanner {
 public:
  explicit PlotPlanner(const Options& options) : options_(options) {}

  void check(PlannedScene& planned) const {
    settle_folder(planned.file);
    settle_folder(planned.folder);
    LoadOptions load = load_options(options_, true);
    load.set.clear();
    SceneFile file(former_scene_file(planned.file), load);
    if (is_same_folder(planned.folder, planned.file)) planned.folder = planned.file;
    const bool in_place = planned.folder == planned.file;

    // The run, of which the charts that are possible need not be there.
    optional<PossibleCharts> charts;
    auto former =
        make_shared<FormerRun>(read_former_run(planned.file, file, [&](const FormerRun& run, string_view name) {
          if (!charts) charts = possible_charts(run);
          // In another folder pictures are not needed. In the run's own they stay, and must be right.
          return is_drawn_by(*charts, name) || (!in_place && depends_on_look(name));
        }));

    // The scene of the folder that is written.
    planned.scene = make_unique<Scene>(file.scene());
    if (const auto settings = settings_of_tables(*planned.scene, *former); !in_place && !settings.empty())
      *planned.scene = file.scene(settings);

    vector<string> outputs = {string(plot_files.folder)};
    for (const OutputKind& kind : output_kinds())
      if (in_place && kind.asked(former->scene.output)) outputs.emplace_back(kind.name);
    planned.scene->output = restricted(planned.scene->output, outputs);
    planned.scene->file = former->scene.file;
    if (const double end = former->read_end_time(); end < planned.scene->simulate.duration)
      planned.scene->known.ends_at = end;

    former->scene = {};
    refuse_other_file(planned.folder);
    inspect_charts(planned, possible_charts(*former));
    planned.former = std::move(former);
  }

 private:
  /// A folder is up to date with all charts of a run, or with all that are possible.
  static void inspect_charts(PlannedScene& planned, const PossibleCharts& charts) {
    planned.found = look_into(planned.folder, *planned.scene);
    if (planned.found.content == FolderContent::this_run) return;
    if (charts.names.empty())
      throw ExportError(
          fmt::format("it has neither tables nor flights to plot\n  carom run {}/scene.yaml --only plots -o OTHER "
                      "simulates it again and draws the charts",
                      printable(planned.file)));

    // The folder may have those that are possible alone.
    vector<string> files = run_files(*planned.scene, planned.scene->output);
    std::erase_if(
        files, [&](const string& name) { return output_with_series(name) != nullptr && !is_drawn_by(charts, name); });
    FolderChanges changes;
    planned.found.content =
        inspect_folder(planned.folder, *planned.scene, outputs_text(planned.scene->output), files, &changes);
    planned.found.obstacle = obstacle_of(changes);

    if (planned.folder == planned.file && planned.found.content != FolderContent::this_run)
      planned.found = look_into_own(planned.folder);
  }

  const Options& options_;
};

/// Lines and members about the charts.
void describe_charts(SceneOutcome& outcome, const PlannedScene& planned, const Options& options) {
  const PossibleCharts charts = possible_charts(*planned.former);
  vector<string> names(charts.names.begin(), charts.names.end());
  outcome.entry["plots"] = names;
  outcome.entry["left_out"] = Json::object();

  Block block(options);
  block.heading(planned.name, planned.scene->title);
  const vector<string> files = files_in(planned.folder);
  for (const LeftOut& chart : charts.missing) {
    // One of the run itself stays.
    if (std::binary_search(files.begin(), files.end(), fmt::format("{}/{}.svg", plot_files.folder, chart.name)))
      continue;
    outcome.entry["left_out"][chart.name] = chart.why;
    block.line("left out", fmt::format("{}: {}", chart.name, chart.why));
  }

  block.line("wrote", fmt::format("{}/{}: {}, each as SVG and PNG", printable(planned.folder), plot_files.folder,
                                  listed(names)));
  outcome.entry["files"] = files;
  outcome.out = block.text();
}

SceneOutcome plot_one(const PlannedScene& planned, const string& gnuplot, const Options& options, Progress& progress) {
  SceneOutcome outcome = without_run(planned, scene_status::failed);
  try {
    plot_run({planned.former.get(), planned.scene.get(), planned.folder, gnuplot}, [&](double done) {
      stop_if_interrupted();
      progress.update(done, done < 1 ? "reading" : "drawing");
    });
    outcome = without_run(planned, scene_status::done);
    describe_charts(outcome, planned, options);
    return outcome;
  } catch (const std::bad_alloc&) {
    outcome.complaint = "not enough memory";
  } catch (const ExportError& error) {
    // Ctrl-C ends gnuplot too: its error is then the interrupt.
    stop_if_interrupted();
    outcome.complaint = error.what();
  }

  outcome.entry["errors"] = errors_json(error_of_text(outcome.complaint, planned.file));
  outcome.complaint = fmt::format("{}: {}", printable(planned.file), outcome.complaint);
  return outcome;
}

int plot_runs(const Options& options) {
  const string gnuplot = find_gnuplot();
  const PlotPlanner planner(options);
  return run_planned(
      options, plan_scenes(planned_folders(options), [&](PlannedScene& run) { planner.check(run); }),
      [&](const PlannedScene& planned, Progress& progress) { return plot_one(planned, gnuplot, options, progress); });
}

}  // namespace

const Command plot_command = {
    "plot",
    plot_runs,
    "draws charts of a run, without simulating again",
    "  carom plot output/gas_in_a_room                      adds plots/ to the run\n"
    "  carom plot output/two_bowling_balls -o charts        writes charts/plots/energy.svg, ...\n"
    "  carom plot output/bowling.sweep/runs/*\n",
    "The charts are energy over time, heights over time, speeds at the end, and collisions a second,\n"
    "each as SVG and PNG by gnuplot. They are those of a run with output.plots: true. A run has what\n"
    "a chart shows in energy.csv, trajectory.csv and collisions.csv; flights.bin replaces the first\n"
    "two. A chart without data is left out, and the report names the key that gives it.\n"
    "Without -o the charts are added to the run, and its other files stay. With -o the other folder\n"
    "is that of carom run DIR/scene.yaml --only plots.\n\n"
    "Exit codes: 0 done or up to date, 1 failed, 2 the command line or a folder is wrong, 130 or 143\n"
    "interrupted.",
    {{"--output", "the folder of the charts; with several runs, the folder\nthat holds theirs (the run's own)"},
     {"--jobs", "N runs at a time (1); changes no result"},
     {"--force", "overwrite other content of the folder, draw again what\nis up to date"},
     {"--progress"}},
    "DIR",
    "folders of runs",
    "name the folder of a run: carom {} output/two_bowling_balls"};

}  // namespace carom
