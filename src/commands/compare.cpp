// Checks folders, measures and charts before the first file is written. The comparison itself is that of a sweep
// (compare/).
#include "commands/commands.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/error_list.h"
#include "commands/found_report.h"
#include "commands/interrupt.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/text.h"
#include "compare/compared_run.h"
#include "compare/comparison_folder.h"
#include "compare/stored_measures.h"
#include "files/folder_writer.h"
#include "files/publication.h"
#include "files/stored_file.h"
#include "overlay/font.h"
#include "overlay/text_notes.h"
#include "scene/scene.h"
#include "scene/scene_values.h"
#include "std.h"
#include "study/common_films.h"
#include "study/comparison_film.h"
#include "study/run_list.h"
#include "study/sweep_folder.h"
#include "yaml/diagnostics.h"
#include "yaml/source.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

/// Title of the workbook: the names of the runs, shortened.
string title_of(const vector<string>& folders) {
  vector<string> names;
  for (const string& folder : folders) names.push_back(name_of_folder(folder));
  constexpr size_t most = 4;
  return "Comparison of " + listed(names, most);
}

class CompareSession {
 public:
  explicit CompareSession(const Options& options)
      : options_(options), folder_(options.output.value_or("output/comparison")) {}

  int go() {
    document_["folder"] = folder_;
    try {
      return compare();
    } catch (const Interrupted& stop) {
      complain(options_, "interrupted; nothing was written");
      return end("interrupted", stop.exit_code());
    } catch (const UsageError&) {
      throw;
    } catch (const MeasureError& error) {
      return fail("wrong", error.what(), 2);
    } catch (const std::exception& error) {
      // Ctrl-C ends ffmpeg too: its error is then the interrupt.
      stop_if_interrupted();
      return fail("failed", reason_of(error), 1);
    }
  }

 private:
  int compare() {
    settle_folder(folder_);
    for (const string& folder : options_.operands) refuse_own_folder(folder);

    // The runs, and what differs between them.
    vector<ListedRun> runs;
    try {
      runs = list_runs(options_.operands, stop_if_interrupted);
    } catch (const ExportError& error) {
      return fail("wrong", error.what(), 2);
    }
    // The file of a single sweep has the varied paths and the measures.
    const auto sweep = options_.operands.size() == 1 ? sweep_of(options_.operands[0], runs) : nullopt;
    const RunSet differences = sweep ? RunSet(std::move(runs), *sweep) : RunSet(std::move(runs), stop_if_interrupted);

    vector<FilmTile> tiles;
    try {
      if (options_.compare.video) tiles = film_tiles(differences);
    } catch (const ExportError& error) {
      return fail("wrong", error.what(), 2);
    }

    vector<string> labels;
    for (const FilmTile& tile : tiles) labels.insert(labels.end(), tile.labels.begin(), tile.labels.end());
    for (const string& note : text_notes("the labels of the film", labels, true)) remark(options_, note);

    // What is compared: the sweep's own choice, with that of the command line.
    ComparisonPlan plan = sweep ? comparison_plan(*sweep, {}) : ComparisonPlan();
    plan.own = own_measures_of(differences.runs());
    if (!sweep) plan.title = title_of(options_.operands);
    plan.parameters = differences.parameters();
    plan.seed = differences.seed();

    if (!options_.compare.measures.empty()) plan.measures = options_.compare.measures;
    if (!options_.compare.charts.empty()) plan.charts.clear();
    for (const ChartWords& chart : options_.compare.charts) plan.charts.push_back({chart.x, chart.y, chart.by});
    plan.collisions = plan.collisions || options_.compare.collisions;
    check(plan, differences.runs());

    // Nothing but a comparison of these runs is replaced.
    const string request =
        request_text(plan, digest_of(differences.runs(), stop_if_interrupted), options_.compare.video);
    FolderChanges changes;
    const FolderContent content = inspect_comparison_folder(folder_, request, changes);
    if (content == FolderContent::this_run && !options_.force) return up_to_date();
    if ((content == FolderContent::other_run || content == FolderContent::touched) && !options_.force)
      return fail("wrong",
                  fmt::format("the folder {} holds {}\n  write elsewhere with -o, or overwrite it with --force",
                              printable(folder_),
                              content == FolderContent::touched ? comparison_obstacle(changes) : "something else"),
                  2);

    write(plan, differences, std::move(tiles), request);
    return done(plan, differences);
  }

  /// A comparison never overwrites a run that it compares.
  void refuse_own_folder(const string& folder) const {
    if (canonical(folder) == canonical(folder_))
      throw UsageError(fmt::format("{} is both compared and written to", printable(folder)),
                       "name another folder with -o");
  }

  /// The names of the measures that the scene of the first whole run defines.
  static vector<string> own_measures_of(const vector<ListedRun>& runs) {
    const auto whole = ranges::find_if(runs, [](const ListedRun& run) { return run.done; });
    if (whole == runs.end()) return {};
    const Descriptor folder = open_folder(AT_FDCWD, whole->folder, true);
    const auto text = folder ? read_text(folder.get(), "scene.yaml", max_source_bytes) : nullopt;
    return text ? own_measure_names(*text) : vector<string>();
  }

  /// Measures and charts must exist in the first whole run.
  static void check(const ComparisonPlan& plan, const vector<ListedRun>& runs) {
    check_charts(plan);
    const auto whole = ranges::find_if(runs, [](const ListedRun& run) { return run.done; });
    const vector<Measure> measures = measures_of(plan);
    const bool of_bodies = any_of(measures, [](const Measure& m) { return !m.column; });
    if (!of_bodies || whole == runs.end()) return;
    const Scene scene = load_run_scene(whole->folder);
    for (const Measure& measure : measures) parse_measure(measure.name, scene);
  }

  void write(const ComparisonPlan& plan, const RunSet& differences, vector<FilmTile> tiles, const string& request) {
    const size_t count = differences.runs().size();
    Progress progress(options_, "compare");
    const ComparisonWatch watch{stop_if_interrupted, [&](size_t read) { progress.update(read, count, "runs"); },
                                [&](size_t runs) { doubtful_ = runs; }};

    ComparisonFolder folder(folder_);
    unique_ptr<SideBySide> film;
    optional<CommonFilms> redrawn;
    if (options_.compare.video) {
      progress.update(0, "film");
      redrawn.emplace(folder.place(), tiles, stop_if_interrupted);
      film = make_unique<SideBySide>(folder.place(), comparison_film_name, std::move(tiles),
                                     find_font("the text of a film", "leave --video out"));
    }

    const auto files = write_comparison(
        folder.place(), plan, count, [&](size_t number) { return differences.run(number); }, watch);
    if (film) {
      progress.update(1, "film");
      film->complete();
    }

    stop_if_interrupted();
    progress.clear();
    folder.publish(files, film.get(), request);
  }

  int up_to_date() { return end("up to date", 0, fmt::format("{}: up to date\n", printable(folder_))); }

  int done(const ComparisonPlan& plan, const RunSet& differences) {
    const vector<ListedRun>& runs = differences.runs();
    const auto failed = size_t(ranges::count_if(runs, [](const ListedRun& run) { return !run.done; }));
    vector<string> varied, measures;
    for (const Parameter& parameter : plan.parameters) varied.push_back(parameter.path);
    for (const Measure& measure : measures_of(plan)) measures.push_back(measure.name);

    document_["runs"] = runs.size();
    document_["failed"] = failed;
    document_["doubtful"] = doubtful_;
    document_["parameters"] = varied;
    document_["measures"] = measures;
    const vector<string> files = files_in(folder_);
    document_["files"] = files;
    const vector<FoundMeasure> found = stored_findings(folder_, plan);
    document_["found"] = found_json(found);

    constexpr size_t most = 12;
    Block block(options_);
    block.heading(plan.title.empty() ? title_of(options_.operands) : plan.title, "");
    block.line("runs", failed == 0 ? grouped(runs.size()) : fmt::format("{}, {} failed", grouped(runs.size()), failed));
    describe_doubtful(block, doubtful_);
    block.line("varied", varied.empty() ? "nothing" : listed(varied, most));
    block.line("measures", listed(measures, most));
    describe(block, found);
    block.line("wrote", fmt::format("{}: {}", printable(folder_), listed(files, most)));
    return end("done", 0, block.text());
  }

  int fail(const char* status, const string& text, int code) {
    complain(options_, text);
    document_["errors"] = errors_json(error_of_text(text));
    return end(status, code);
  }

  int end(const char* status, int code, string_view text = {}) {
    document_["status"] = status;
    return print_end(options_, code, document_, text);
  }

  const Options& options_;
  string folder_;
  size_t doubtful_ = 0;  // runs
  Json document_ = Json::object();
};

}  // namespace

const Command compare_command = {
    "compare",
    [](const Options& options) { return CompareSession(options).go(); },
    "compares any runs: a table, a workbook with charts, a film",
    "  carom compare output/half output/full            writes output/comparison/\n"
    "  carom compare output/falls --measures collisions,balls.red.speed_m_per_s\n"
    "  carom compare output/a output/b --video -o side  their films side by side too\n",
    "A folder is that of a run, or of a sweep with all its runs. The parameters are the values in which the\n"
    "scenes differ. The comparison gets summary.csv (a row a run), comparison.xlsx, index.html for browsers,\n"
    "manifest.json and, with repeats (scenes that differ only in the seed), repeats.csv.\n\n"
    "Exit codes: 0 done or up to date, 1 the comparison failed, 2 the command line is wrong, 130 or 143\n"
    "interrupted.",
    {{"--output", "the comparison's folder (output/comparison)"},
     {"--measures"},
     {"--charts"},
     {"--collisions"},
     {"--video", "the runs' films side by side, in step, as\ncomparison.mp4; of at most 16 runs"},
     {"--force", "overwrite other content of the folder, compare again\nwhat is up to date"},
     {"--progress"}},
    "DIR",
    "folders of runs, or of sweeps",
    "name the folders of runs: carom {} output/half output/full"};

}  // namespace carom
