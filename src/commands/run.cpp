#include "commands/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "commands/accuracy_report.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/text.h"
#include "render/renderer.h"
#include "study/workers.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

/// What became of a scene, and what is printed of it.
struct Told {
  std::string status;
  Json entry;             // of the document of --json
  std::string out;        // for stdout
  std::string complaint;  // for stderr; empty: none
};

/// All scenes of one command line, and what was said of them.
class Session {
 public:
  Session(const Options& options, std::string_view command, std::vector<PlannedScene> scenes)
      : options_(options),
        command_(command),
        palette_(wants_color(options.color, STDOUT_FILENO)),
        width_(terminal_width(STDOUT_FILENO)),
        scenes_(std::move(scenes)) {}

  int go() {
    refuse_other_content(scenes_, options_);
    if (const std::string errors = error_count(scenes_); !errors.empty()) return refuse(errors);
    const auto start = std::chrono::steady_clock::now();
    const auto to_do = static_cast<std::size_t>(std::count_if(
        scenes_.begin(), scenes_.end(), [&](const PlannedScene& planned) { return !is_up_to_date(planned); }));
    const std::size_t jobs = std::min<std::size_t>(options_.jobs.value_or(1), to_do);
    const int code = jobs > 1 ? run_together(jobs, to_do) : run_in_turn();
    if (options_.json) write_out(document(command_, document_));
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (scenes_.size() > 1 && !options_.json && !options_.quiet) write_out(total(wall));
    if (code != 0) return code;
    return counts_[failed] > 0 ? 1 : 0;
  }

 private:
  static constexpr const char *done = "done", *up_to_date = "up to date", *failed = "failed",
                              *interrupted = "interrupted", *not_run = "not run";

  int refuse(const std::string& errors) {
    for (const PlannedScene& planned : scenes_) {
      write_err(planned.error);
      Json entry = begin(planned, planned.errors > 0 ? "wrong" : not_run);
      if (planned.errors > 0) entry["error"] = planned.error;
      document_.push_back(entry);
    }
    complain(options_, errors + "; nothing was run");
    if (options_.json) write_out(document(command_, document_));
    return 2;
  }

  bool is_up_to_date(const PlannedScene& planned) const {
    return planned.content == FolderContent::this_run && !options_.force;
  }

  // These two give the exit code of an interrupt, or 0.

  int run_in_turn() {
    int code = 0;
    for (PlannedScene& planned : scenes_) {
      try {
        settle(code != 0 ? told(planned, not_run) : run_one(planned, progress_choice(options_)));
      } catch (const Interrupted& signal) {
        settle(told_interrupted(planned));
        code = signal.exit_code();
      }
      planned.scene.reset();  // the next one may need the memory
    }
    return code;
  }

  /// Scenes in processes of their own; what is printed of them comes in their order.
  int run_together(std::size_t jobs, std::size_t to_do) {
    std::vector<std::optional<Told>> all(scenes_.size());
    std::size_t begun = 0, settled = 0;
    Progress progress(progress_choice(options_), wants_color(options_.color, STDERR_FILENO), std::string(command_), 1,
                      0);
    const auto settle_next = [&] {
      for (; settled < all.size() && all[settled]; ++settled) {
        progress.clear();
        settle(*std::exchange(all[settled], Told{}));
      }
    };
    std::size_t finished = 0;
    Tasks tasks;
    tasks.next = [&]() -> std::optional<std::size_t> {
      for (; begun < scenes_.size() && is_up_to_date(scenes_[begun]); ++begun)
        all[begun] = told_up_to_date(scenes_[begun]);
      return begun < scenes_.size() ? std::optional(begun++) : std::nullopt;
    };
    tasks.work = [&](std::size_t i) {
      const Told one = run_one(scenes_[i], ProgressChoice::none);
      return Json::array({one.status, one.entry, one.out, one.complaint})
          .dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    tasks.done = [&](const TaskOutcome& outcome) {
      if (outcome.kind == TaskOutcome::Kind::done) {
        Json parts = Json::parse(outcome.text);
        all[outcome.task] = Told{parts[0], std::move(parts[1]), parts[2], parts[3]};
      } else {
        all[outcome.task] = told_failed(scenes_[outcome.task], outcome.text);
      }
      settle_next();
      progress.update(++finished, to_do, "scenes");
    };
    tasks.look = stop_if_interrupted;
    share_processors(jobs);
    try {
      work_off(tasks, jobs);
    } catch (const Interrupted& signal) {
      for (std::size_t i = 0; i < all.size(); ++i)
        if (i >= settled && !all[i]) all[i] = i < begun ? told_interrupted(scenes_[i]) : told(scenes_[i], not_run);
      settle_next();
      return signal.exit_code();
    }
    settle_next();
    return 0;
  }

  /// Throws Interrupted.
  Told run_one(const PlannedScene& planned, ProgressChoice choice) const {
    if (is_up_to_date(planned)) return told_up_to_date(planned);
    Progress progress(choice, wants_color(options_.color, STDERR_FILENO), label(planned),
                      planned.scene->simulate.duration, planned.forecast.frames);
    try {
      const RunWatch watch{stop_if_interrupted, [&](double time, std::uint64_t collisions, std::uint64_t pictures) {
                             progress.update(time, collisions, pictures);
                           }};
      return told_done(planned, run_scene(show_of(planned), planned.engine, settings_of(planned), watch));
    } catch (const std::bad_alloc&) {
      return told_failed(planned, "not enough memory");
    } catch (const std::exception& error) {
      return told_failed(planned, error.what());
    }
  }

  static Show show_of(const PlannedScene& planned) {
    Show show{planned.scene.get(), planned.folder, planned.load_s};
    if (planned.former && planned.former->folder == planned.folder) show.renewed = &planned.former->manifest;
    return show;
  }

  RunSettings settings_of(const PlannedScene& planned) const {
    RunSettings settings;
    if (!planned.former) return settings;
    const FormerRun& former = *planned.former;
    settings.warnings = former.manifest.warnings;
    if (former.has_flights())
      settings.simulator = [&former](const Scene& scene) { return former.motion(scene); };
    else if (!options_.quiet)
      write_err(fmt::format("{}: no flights are stored there: simulating again\n", printable(former.folder)));
    settings.measure = [&former](const Scene&, const State&, const Summary& summary) {
      if (summary.collisions != former.manifest.collisions)
        throw ExportError(fmt::format("the motion is another one: {} collisions, not {}", summary.collisions,
                                      former.manifest.collisions));
      return former.manifest.measures;
    };
    return settings;
  }

  static Told told(const PlannedScene& planned, const char* status) { return {status, begin(planned, status), {}, {}}; }

  Told told_done(const PlannedScene& planned, const RunResult& result) const {
    Told one = told(planned, done);
    one.entry["summary"] = summary_json(result.summary);
    one.entry["contact"] = contact_json(result.summary);
    if (!result.summary.energy.of_forces.empty()) one.entry["work"] = work_json(result.summary);
    one.entry["warnings"] = warnings_json(result.summary.warnings);
    one.entry["files"] = files_in(planned.folder);
    one.entry["time"] = facts_json(result);
    Block block(palette_, width_);
    block.heading(planned.name, planned.scene->title);
    describe(block, planned, result);
    if (options_.accuracy) {
      const AccuracyReport accuracy = report_accuracy(*planned.scene, result.engine);
      one.entry["accuracy"] = accuracy.json;
      for (const auto& [label, text] : accuracy.lines) block.line(label, text);
    }
    one.out = block.text();
    if (options_.quiet)
      for (const Warning& warning : result.summary.warnings)
        one.complaint += fmt::format("{}{}: doubtful: {}",
                                     one.complaint.empty() ? "" : "\ncarom: ", printable(planned.file), warning.text);
    return one;
  }

  Told told_up_to_date(const PlannedScene& planned) const {
    Told one = told(planned, up_to_date);
    one.entry["files"] = files_in(planned.folder);
    const std::vector<Warning> warnings = warnings_in(planned.folder);
    one.entry["warnings"] = warnings_json(warnings);
    Block block(palette_, width_);
    block.heading(planned.name, planned.scene->title);
    block.line("up to date", printable(planned.folder));
    describe(block, warnings);
    one.out = block.text();
    return one;
  }

  static Told told_failed(const PlannedScene& planned, std::string_view text) {
    Told one = told(planned, failed);
    one.entry["error"] = std::string(text);
    one.complaint = fmt::format("{}: the run failed: {}", printable(planned.file), text);
    return one;
  }

  static Told told_interrupted(const PlannedScene& planned) {
    Told one = told(planned, interrupted);
    one.complaint = fmt::format("{}: interrupted; the same command runs what is missing", printable(planned.file));
    return one;
  }

  void settle(Told one) {
    ++counts_[one.status];
    if (!one.complaint.empty()) complain(options_, one.complaint);
    document_.push_back(std::move(one.entry));
    if (options_.json || options_.quiet || one.out.empty()) return;
    write_out(one.out);
    flush_out();
  }

  static Json begin(const PlannedScene& planned, std::string_view status) {
    return {{"scene", planned.file}, {"status", std::string(status)}, {"folder", planned.folder}};
  }

  std::string total(double wall) {
    std::vector<std::string> parts;
    std::size_t rest = scenes_.size();
    for (const char* status : {done, up_to_date, failed}) {
      if (counts_[status] > 0) parts.push_back(fmt::format("{} {}", counts_[status], status));
      rest -= counts_[status];
    }
    if (rest > 0) parts.push_back(fmt::format("{} not finished", rest));
    return fmt::format("{} scenes: {}, in {}\n", scenes_.size(), fmt::join(parts, ", "), wait_text(wall));
  }

  std::string label(const PlannedScene& planned) const {
    const auto number = static_cast<std::size_t>(&planned - scenes_.data()) + 1;
    const std::string name = printable(planned.name);
    return scenes_.size() == 1 ? name : fmt::format("{}/{} {}", number, scenes_.size(), name);
  }

  const Options& options_;
  const std::string_view command_;
  Palette palette_;
  std::size_t width_;
  std::vector<PlannedScene> scenes_;
  Json document_ = Json::array();
  std::map<std::string, std::size_t> counts_;  // of scenes, by status
};

}  // namespace

const CommandText& run_text() {
  static const CommandText text = {
      "run",
      "simulates scenes and writes what they ask for",
      "  carom run scenes/two_bowling_balls.yaml\n"
      "  carom run scene.yaml --only trajectory,collisions     data alone, no pictures\n"
      "  carom run scene.yaml --set balls.red.restitution=0.5 -o output/half\n"
      "  carom run scenes/*.yaml -o results                    results/<scene file's stem>/...\n",
      "Without -o a scene's run goes to output/<scene file's stem>/. All scenes are checked before\n"
      "the first is run. A folder that holds this very run is up to date and costs nothing.\n"
      "\n"
      "Exit codes: 0 done or up to date, 1 a run failed, 2 the command line or a scene is wrong,\n"
      "130 or 143 interrupted.",
      {{"--output"}, {"--set"}, {"--only"}, {"--seed"}, {"--jobs"}, {"--force"}, {"--verbose"}, {"--progress"}}};
  return text;
}

int run_command(const Options& options) {
  return run_planned(options, "run", plan_scenes(options));
}

int run_planned(const Options& options, std::string_view command, std::vector<PlannedScene> scenes) {
  return Session(options, command, std::move(scenes)).go();
}

}  // namespace carom
