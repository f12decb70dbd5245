#include "commands/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <new>

#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/text.h"
#include "render/renderer.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

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
    int interrupted = 0;
    for (PlannedScene& planned : scenes_) {
      if (interrupted != 0) {
        note(planned, "not run");
        continue;
      }
      interrupted = run_one(planned);
      planned.scene.reset();  // the next one may need the memory
    }
    if (options_.json) write_out(document(command_, document_));
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (scenes_.size() > 1 && !options_.json && !options_.quiet) write_out(total(wall));
    if (interrupted != 0) return interrupted;
    return failed_ > 0 ? 1 : 0;
  }

 private:
  int refuse(const std::string& errors) {
    for (const PlannedScene& planned : scenes_) {
      write_err(planned.error);
      Json entry = begin(planned, planned.errors > 0 ? "wrong" : "not run");
      if (planned.errors > 0) entry["error"] = planned.error;
      document_.push_back(entry);
    }
    complain(options_, errors + "; nothing was run");
    if (options_.json) write_out(document(command_, document_));
    return 2;
  }

  // Gives the exit code of an interrupt, or 0.
  int run_one(const PlannedScene& planned) {
    if (planned.content == FolderContent::this_run && !options_.force) {
      up_to_date(planned);
      return 0;
    }
    Progress progress(progress_choice(options_), wants_color(options_.color, STDERR_FILENO), label(planned),
                      planned.scene->simulate.duration, planned.forecast.frames);
    try {
      const RunWatch watch{stop_if_interrupted, [&](double time, std::uint64_t collisions, std::uint64_t pictures) {
                             progress.update(time, collisions, pictures);
                           }};
      const RunResult result = run_scene(show_of(planned), planned.engine, settings_of(planned), watch);
      progress.clear();
      done(planned, result);
      return 0;
    } catch (const Interrupted& interrupted) {
      return interrupt(planned, progress, interrupted);
    } catch (const std::bad_alloc&) {
      fail(planned, progress, "not enough memory");
    } catch (const std::exception& error) {
      fail(planned, progress, error.what());
    }
    return 0;
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

  void done(const PlannedScene& planned, const RunResult& result) {
    ++done_;
    Json entry = begin(planned, "done");
    entry["summary"] = summary_json(result.summary);
    entry["contact"] = contact_json(result.summary);
    entry["files"] = files_in(planned.folder);
    entry["time"] = facts_json(result);
    document_.push_back(entry);
    Block block(palette_, width_);
    block.heading(planned.name, planned.scene->title);
    describe(block, planned, result);
    show(block);
  }

  void up_to_date(const PlannedScene& planned) {
    ++up_to_date_;
    Json entry = begin(planned, "up to date");
    entry["files"] = files_in(planned.folder);
    document_.push_back(entry);
    Block block(palette_, width_);
    block.heading(planned.name, planned.scene->title);
    block.line("up to date", printable(planned.folder));
    show(block);
  }

  void fail(const PlannedScene& planned, Progress& progress, std::string_view text) {
    ++failed_;
    progress.clear();
    complain(options_, fmt::format("{}: the run failed: {}", printable(planned.file), text));
    Json entry = begin(planned, "failed");
    entry["error"] = std::string(text);
    document_.push_back(entry);
  }

  int interrupt(const PlannedScene& planned, Progress& progress, const Interrupted& interrupted) {
    progress.clear();
    complain(options_, fmt::format("{}: interrupted; the same command runs what is missing", printable(planned.file)));
    note(planned, "interrupted");
    return interrupted.exit_code();
  }

  void note(const PlannedScene& planned, std::string_view status) { document_.push_back(begin(planned, status)); }

  static Json begin(const PlannedScene& planned, std::string_view status) {
    return {{"scene", planned.file}, {"status", std::string(status)}, {"folder", planned.folder}};
  }

  void show(const Block& block) const {
    if (options_.json || options_.quiet) return;
    write_out(block.text());
    flush_out();
  }

  std::string total(double wall) const {
    std::vector<std::string> parts;
    if (done_ > 0) parts.push_back(fmt::format("{} done", done_));
    if (up_to_date_ > 0) parts.push_back(fmt::format("{} up to date", up_to_date_));
    if (failed_ > 0) parts.push_back(fmt::format("{} failed", failed_));
    const std::size_t rest = scenes_.size() - done_ - up_to_date_ - failed_;
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
  std::size_t done_ = 0, up_to_date_ = 0, failed_ = 0;
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
      "Scenes run one after another: --jobs is taken and changes nothing.\n\n"
      "Exit codes: 0 done or up to date, 1 a run failed, 2 the command line or a scene is wrong,\n"
      "130 or 143 interrupted.",
      {{"--output"}, {"--set"}, {"--only"}, {"--seed"}, {"--jobs"}, {"--force"}, {"--progress"}}};
  return text;
}

int run_command(const Options& options) {
  return run_planned(options, "run", plan_scenes(options));
}

int run_planned(const Options& options, std::string_view command, std::vector<PlannedScene> scenes) {
  return Session(options, command, std::move(scenes)).go();
}

}  // namespace carom
