// Plans a run whose motion comes from the flights of a former run. It is then run as by `carom run`, so drawing has no
// loop of its own.
#include "commands/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "commands/batch.h"
#include "commands/idle_settings.h"
#include "commands/plan.h"
#include "commands/still.h"
#include "commands/text.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "files/series_folders.h"
#include "overlay/text_notes.h"
#include "run/requirements.h"
#include "run/stopwatch.h"
#include "scene/motion_text.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {

namespace {

/// The outputs that are drawn, or those that are not; flights are neither.
vector<string> names_of(const Output& output, bool draws) {
  vector<string> names;
  for (const OutputKind& kind : output_kinds())
    if (kind.asked(output) && kind.draws == draws && kind.name != "flights") names.emplace_back(kind.name);
  return names;
}

void refuse_tables(const Options& options) {
  const vector<string> drawn = names_of(with_all({}), true);
  for (const string& name : options.only.value_or(vector<string>{}))
    if (!contains(drawn, name))
      throw UsageError(fmt::format("render makes {}", joined(drawn, ", ")),
                       fmt::format("carom {} {}", name == plot_files.folder ? "plot makes" : "run writes", name));
}

/// Charts show tables and flights, whatever the pictures. Tables stay as they are.
void refuse_settings(const Options& options, const string& folder) {
  const string charts = fmt::format("output.{}", plot_files.folder), tables = "output.tables";
  for (const string& set : options.set) {
    const string path = set.substr(0, set.find('='));
    if (path == tables || path.starts_with(tables + "."))
      throw ExportError(fmt::format("--set {}: render writes no tables\n  carom run {}/scene.yaml --set {} writes them",
                                    printable(set), printable(folder), printable(shell_word(set))));
    if (path == charts)
      throw ExportError(fmt::format("--set {}: render makes no {}\n  carom plot {} makes them", printable(set),
                                    plot_files.whats, printable(folder)));
  }
}

/// As typed in a shell.
string settings_text(const vector<string>& settings) {
  string text;
  for (const string& setting : settings) text += " --set " + shell_word(setting);
  return text;
}

Scene scene_with(SceneFile& file, const vector<string>& set) {
  vector<Setting> settings;
  for (const string& text : set) settings.push_back({text, ""});
  return file.scene(settings);
}

class Planner {
 public:
  explicit Planner(const Options& options) : options_(options) {}

  void check(PlannedScene& planned) {
    const auto start = std::chrono::steady_clock::now();
    settle_folder(planned.file);
    settle_folder(planned.folder);
    refuse_settings(options_, planned.file);

    // The run by its own scene, then that scene with what the command line changes.
    const string path = former_scene_file(planned.file);
    LoadOptions load = load_options(options_, true);
    load.set.clear();
    SceneFile file(path, load);
    auto former = make_shared<FormerRun>(
        read_former_run(planned.file, file, [](const FormerRun&, string_view name) { return depends_on_look(name); }));

    if (is_same_folder(planned.folder, planned.file)) planned.folder = planned.file;
    planned.scene = make_unique<Scene>(scene_with(file, options_.set));
    refuse_other_motion(file, *former, *planned.scene, path);

    if (!options_.at) {
      const bool in_place = planned.folder == planned.file;
      choose_outputs(*planned.scene, *former, in_place);
      planned.notes = idle_settings(options_.set, *planned.scene, [&](const vector<string>& set) {
        Scene other = scene_with(file, set);
        choose_outputs(other, *former, in_place);
        return other;
      });
      for (string& note : text_notes(*planned.scene)) planned.notes.push_back(std::move(note));
    }

    planned.scene->file = former->scene.file;
    planned.load_s = since(start);

    planned.price = price_of(*planned.scene);
    refuse_other_file(planned.folder);
    if (options_.at)
      check_time(former->read_end_time());
    else
      check_content(planned);
    if (options_.at || !is_up_to_date(planned, options_))
      requirements_.check(file, *planned.scene, outputs_drawn(*planned.scene));

    if (planned.folder == planned.file && !former->manifest.origin.path.empty()) {
      planned.origin = former->manifest.origin;
      for (const string& set : options_.set) planned.origin.settings.push_back(valid_utf8(set));
    }
    // One scene in memory is enough.
    former->scene = {};
    planned.former = std::move(former);
  }

 private:
  void check_content(PlannedScene& planned) const {
    if (!options_.force) hold_to_budget(*planned.scene, planned.price.forecast, "this would make");
    planned.found = look_into(planned.folder, *planned.scene);
    const bool renews = planned.folder == planned.file;
    if (renews && planned.found.content != FolderContent::this_run) planned.found = look_into_own(planned.folder);
  }

  /// The names by which the page of a run finds its pictures.
  static vector<string> drawn_files(const Output& output) {
    vector<string> names = names_of(output, true);
    if (output.video) names.push_back(output.video->file);
    return names;
  }

  /// The outputs of a scene that this command draws. The charts of a run stay.
  Output outputs_drawn(const Scene& scene) const {
    if (!options_.at) return restricted(scene.output, names_of(scene.output, true));
    Output picture;
    picture.frames.emplace();
    return picture;
  }

  void check_time(double end) const {
    if (*options_.at > end)
      throw ExportError(
          fmt::format("--at {} is after its end\n  name a time from 0 to {} s", shortest(*options_.at), shortest(end)));
  }

  void refuse_other_motion(SceneFile& file, const FormerRun& former, const Scene& scene, const string& path) const {
    const string motion = motion_text(former.scene);
    if (motion_text(scene) == motion) return;
    vector<string> sets;
    for (const string& set : options_.set) {
      sets.push_back(set);
      if (motion_text(scene_with(file, sets)) == motion) continue;
      throw ExportError(
          fmt::format("--set {} changes the motion, which needs a new simulation\n  carom run {}{} -o OTHER runs it",
                      printable(set), printable(path), printable(settings_text(options_.set))));
    }
  }

  /// `in_place`: the pictures replace the run's own.
  void choose_outputs(Scene& scene, const FormerRun& former, bool in_place) const {
    Output& output = scene.output;
    const Output requested = output;
    output = restricted(requested, options_.only.value_or(names_of(requested, true)));
    if (names_of(output, true).empty())
      throw ExportError("its scene has no pictures\n  add them with --only frames, video or sheet");
    output.flights = requested.flights;
    if (!in_place) return;

    // The other files of the run stay, so that they must be those of the changed scene.
    const vector<string> tables = names_of(former.scene.output, false);
    Output kept = restricted(requested, tables);
    if (outputs_text(kept) != outputs_text(restricted(former.scene.output, tables)))
      throw ExportError(fmt::format("--set changes one of {}, which render leaves as they are\n  carom run writes them",
                                    joined(tables, ", ")));
    if (kept.plots && scene.title != former.scene.title)
      throw ExportError(
          fmt::format("--set changes the title, which the charts in {}/ show and render leaves as they are\n"
                      "  render to another folder with -o",
                      plot_files.folder));

    if (kept.report && (scene.title != former.scene.title || drawn_files(output) != drawn_files(former.scene.output)))
      throw ExportError(
          fmt::format("the pictures have other names or another title than in {}, which render leaves as it is\n"
                      "  render to another folder with -o",
                      page_name));

    for (const OutputKind& kind : output_kinds())
      if (kind.asked(output)) kind.member.add(kept, output);
    output = kept;
  }

  const Options& options_;
  Requirements requirements_;
};

int render_runs(const Options& options) {
  refuse_tables(options);
  if (options.at && options.only) throw UsageError("--at draws one picture", "leave out --only");
  Planner planner(options);
  vector<PlannedScene> runs =
      plan_scenes(planned_folders(options), [&](PlannedScene& planned) { planner.check(planned); });
  if (!options.at) return run_planned(options, std::move(runs));
  return run_planned(options, std::move(runs),
                     [&](const PlannedScene& planned, Progress&) { return still_of(planned, options); });
}

}  // namespace

const Command render_command = {
    "render",
    render_runs,
    "draws other pictures of a run, without simulating again",
    "  carom render output/ten_pins --set camera.eye.y=9       the run's pictures, from higher up\n"
    "  carom render output/ten_pins --set output.video.speed=0.125 -o output/slow\n"
    "  carom render output/ten_pins --only sheet --set \"output.sheet={columns: 8, rows: 8}\"\n"
    "  carom render output/ten_pins --at 1.25                  still_1.25s.png, one picture\n",
    "A run keeps the paths of its bodies in flights.bin, so that any instant is exact. With -o the\n"
    "pictures go to another folder, as carom run --only frames,video,sheet would write it. Without -o\n"
    "they replace the run's own, and its other files stay. --set may change the camera, lights,\n"
    "colours, background and the pictures and their times. A change of the motion is an error.\n"
    "A run without flights (engines stepped and book, or output.flights: false) is simulated again.\n\n"
    "Exit codes: 0 done or up to date, 1 failed, 2 the command line, a folder or a change is wrong,\n"
    "130 or 143 interrupted.",
    {{"--output", "the folder of the pictures; with several runs, the folder\nthat holds theirs (the run's own)"},
     {"--set"},
     {"--only",
      "draw only these, of frames, video, sheet, vtk, xyz, gltf;\none that the scene lacks is drawn with default "
      "settings;\nframes, video and sheet take theirs from each other"},
     {"--at",
      "draw one picture at this time, still_SECONDSs.png; size and\nquality are those of the frames, or of the film"},
     {"--jobs", "N runs at a time (1); changes no result"},
     {"--force"},
     {"--progress"}},
    "DIR",
    "folders of runs",
    "name the folder of a run: carom {} output/two_bowling_balls"};

}  // namespace carom
