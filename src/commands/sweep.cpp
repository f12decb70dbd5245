// Plans all runs, then simulates what is missing, then compares. A part of a sweep leaves the comparison to `gather`.
#include "commands/commands.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/sweep_report.h"
#include "commands/sweep_setup.h"
#include "commands/text.h"
#include "compare/comparison_folder.h"
#include "files/publication.h"
#include "numerics/processors.h"
#include "run/stopwatch.h"
#include "scene/scene.h"
#include "std.h"
#include "study/sweep_folder.h"

namespace carom {

namespace fs = std::filesystem;

namespace {

class SweepSession {
 public:
  explicit SweepSession(const Options& options)
      : options_(options), folder_(sweep_folder_of(options)), shard_(shard_of(options)) {}

  int go() {
    try {
      return sweep();
    } catch (const SceneError& error) {
      write_err(error.what());
      complain(options_, fmt::format("{}: nothing was run", counted(error.count, "error", "errors")));
      return show_failure(options_, 2, error.records);

    } catch (const Interrupted& interrupted) {
      progress_.reset();
      complain(options_, fmt::format("{}: interrupted; the same command runs what is missing",
                                     printable(options_.operands.front())));
      return show_failure(options_, interrupted.exit_code(), {});

    } catch (const ExportError& error) {
      progress_.reset();
      const string why = with_remedy(error.what());
      complain(options_, why);
      return show_failure(options_, 1, error_of_text(why), cut_);
    }
  }

 private:
  int sweep() {
    SweepSettings settings = sweep_settings(options_);
    settings.checks_requirements = true;
    SweepJob job(read_sweep(options_), folder_, std::move(settings));
    check_comparison(job);

    settle_folder(folder_);
    const SweepContent content = inspect_sweep_folder(folder_, job.sweep(), job.base_text());
    if (content == SweepContent::other && !options_.force) {
      return refuse(fmt::format("the folder {} holds something else, or the sweep or its base has changed since",
                                printable(folder_)));
    }

    if (content == SweepContent::this_sweep && !options_.force && !options_.sweep.plan &&
        !may_read_files(job.sweep(), job.base_text()) && stored_failures(folder_).empty()) {
      SweepOutcome outcome{"up to date", 0, job.sweep().size(), {}, 0};
      outcome.skipped = stored_skips(folder_);
      outcome.runs -= outcome.skipped.size();
      return show_outcome(options_, outcome, job);
    }

    if (const string changed = comparison_obstacle(changes_of_comparison(folder_));
        !changed.empty() && shard_.count <= 1 && !options_.force)
      return refuse(fmt::format("the folder {} holds {}", printable(folder_), changed));

    // Every scenario is checked before the first is run.
    show_progress("scenarios");
    job.plan([&](const SweepProgress& p) { show_progress(p); });
    progress_.reset();

    if (const auto other = options_.force ? nullopt : job.other_content()) {
      const string place = job.run_folder(*other);
      const bool touched = job.runs()[*other].content == FolderContent::touched;
      return refuse(fmt::format("the folder {} holds {}", printable(place),
                                touched ? obstacle_of(find_changes(place)) : "something other than this run"));
    }

    for (const string& path : job.idle_paths())
      complain(options_, fmt::format("{} has no effect on the motion: its value is not used", path));
    for (const string& note : notes_on_start(job)) remark(options_, note);
    return options_.sweep.plan ? show_plan(options_, job) : run(job);
  }

  int refuse(const string& what) const {
    constexpr const char* way_out = "write elsewhere with -o, or overwrite it with --force";
    complain(options_, fmt::format("{}: {}\n  {}", printable(options_.operands.front()), what, way_out));
    return show_failure(options_, 2, error_of_text(what + "\n" + way_out));
  }

  int run(SweepJob& job) {
    const auto start = std::chrono::steady_clock::now();
    const bool is_part = shard_.count > 1;
    SweepFolder folder(folder_, is_part ? SweepFolder::Use::part : SweepFolder::Use::exclusive, job.sweep(),
                       job.base_text(), skipped_text(job.sweep(), job.base_text(), job.invalid()), stop_if_interrupted);

    SweepOutcome outcome;
    for (const InvalidRun& run : job.invalid()) outcome.skipped.emplace_back(job.sweep().id(run.number), run.messages);
    outcome.to_do = job.left();
    share_processors(options_.execution.jobs.value_or(processors()));
    show_progress("runs");

    try {
      job.run([&](const SweepProgress& p) { show_progress(p); },
              [&](size_t number, const string& why) { outcome.failures.emplace_back(number, why); });
    } catch (const ExportError&) {
      const size_t left = job.left(), failed = outcome.failures.size();
      cut_ = {outcome.to_do - left, failed, left - failed};
      throw;
    }

    if (!is_part) {
      vector<RunStatus> statuses;
      for (const PlannedRun& one : job.runs()) statuses.push_back(one.status);
      show_progress("runs compared");

      ComparisonWatch watch;
      watch.stop_check = stop_if_interrupted;
      watch.done = [&](size_t done) {
        show_progress(SweepProgress{done, 0, job.runs().size() - job.invalid().size()});
      };
      watch.doubtful = [&](size_t runs) { outcome.doubtful = runs; };
      folder.finish(job.sweep(), statuses, watch);
    } else {
      sync_file_system(folder_);
    }

    progress_.reset();
    outcome.status = is_part ? fmt::format("part {} of {} done", shard_.index, shard_.count) : "done";
    outcome.runs = job.sweep().size() - job.invalid().size();
    outcome.wall_s = since(start);
    return show_outcome(options_, outcome, job);
  }

  void show_progress(string what) {
    what_ = std::move(what);
    progress_.emplace(options_, printable(fs::path(options_.operands.front()).stem().string()));
  }

  void show_progress(const SweepProgress& p) {
    if (!progress_) return;
    progress_->update(p.done, p.of, what_, p.failed > 0 ? fmt::format(", {} failed", grouped(p.failed)) : "");
  }

  const Options& options_;
  string folder_;
  Shard shard_;
  string what_;
  optional<Progress> progress_;
  optional<SweepCut> cut_;  // once the runs have ended early
};

}  // namespace

const Command sweep_command = {
    "sweep",
    [](const Options& options) {
      if (options.execution.threads) use_threads(*options.execution.threads);
      return SweepSession(options).go();
    },
    "runs a scene with many combinations of values, and compares the runs",
    "  carom sweep scenes/sweeps/bowling.yaml\n"
    "  carom sweep sweep.yaml --plan                         the runs, their values, which are done\n"
    "  carom sweep sweep.yaml -j 4                           four runs at a time\n"
    "  carom sweep scene.yaml --grid restitution.default=0.5:1:6 --grid balls.red.mass=5,10\n"
    "  carom sweep scene.yaml --latin 50 --grid balls.red.mass=5:10 --grid gravity.y=-10:-1\n"
    "  carom sweep sweep.yaml --shard 2/8                    the second of eight parts\n",
    "Without -o a sweep goes to output/<sweep file's stem>/: runs/r0001/..., summary.csv with a row a\n"
    "run, comparison.xlsx, index.html for browsers and manifest.json; with --grid to output/<scene\n"
    "file's stem>.sweep/. All scenarios are checked before the first is run. Scenarios with the same\n"
    "motion share one simulation. A failed run leaves error.txt in its folder and does not stop the\n"
    "others. The same command runs what is missing or failed.\n\n"
    "Exit codes: 0 done or up to date, 1 the folder cannot be written, 2 the command line, the sweep or\n"
    "its scene is wrong, 3 some runs failed, 130 or 143 interrupted.",
    {{"--output", "the sweep's folder (output/<sweep file's stem>)"},
     {"--grid"},
     {"--random"},
     {"--latin"},
     {"--repeat", repeat_help},
     {"--skip-invalid"},
     {"--measures", measures_help},
     {"--best"},
     {"--plan"},
     {"--jobs", "N runs at a time (the number of processors); changes no\nresult"},
     {"--threads"},
     {"--checkpoint"},
     {"--shard"},
     {"--set", "change a value of every run, such as\nsimulate.duration=2; may be repeated"},
     {"--only"},
     {"--seed", seed_help},
     {"--force"},
     {"--progress"}},
    "SWEEP",
    "a sweep file (YAML), or a scene with --grid",
    "name a sweep file, or a scene and what varies: carom {} scene.yaml --grid balls.red.mass=1:2:3",
    1,
    1};

}  // namespace carom
