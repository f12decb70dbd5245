// Scenes run in turn, or in up to --jobs processes (study/workers.h). Finished ones are kept until those before them
// are printed, so that the output has the order of the scenes.
#include "commands/batch.h"

#include <fmt/format.h>

#include <chrono>

#include "commands/interrupt.h"
#include "commands/outcome_list.h"
#include "commands/report.h"
#include "commands/run_one.h"
#include "commands/shared_fractions.h"
#include "commands/text.h"
#include "files/failed_run.h"
#include "numerics/processors.h"
#include "run/stages.h"
#include "run/stopwatch.h"
#include "scene/scene.h"
#include "std.h"
#include "study/workers.h"

namespace carom {
namespace {

int refuse(const Options& options, const vector<PlannedScene>& scenes, const string& errors) {
  nlohmann::ordered_json entries = nlohmann::ordered_json::array();
  for (const PlannedScene& planned : scenes) {
    write_err(planned.error);
    entries.push_back(planned.errors > 0 ? wrong_scene(planned).entry
                                         : without_run(planned, scene_status::not_run).entry);
  }
  complain(options, errors + "; nothing was run");
  return print_end(options, 2, std::move(entries));
}

RunAhead run_ahead(const PlannedScene& planned) {
  const Scene& scene = *planned.scene;
  return {.duration = scene.simulate.duration,
          .pictures = planned.price.forecast.frames,
          .crowd = crowd_ahead(scene, planned.price.engine.engine),
          .draw_s = planned.price.forecast.seconds,
          .draws_after = draws_after_motion(scene)};
}

/// The right scenes of one command line.
class Batch {
 public:
  Batch(const Options& options, vector<PlannedScene>& scenes, const SceneWork& work)
      : options_(options), scenes_(scenes), work_(work) {}

  /// Settles every scene. Gives the program's exit code.
  int go() {
    const auto start = std::chrono::steady_clock::now();
    const auto to_do = size_t(
        ranges::count_if(scenes_, [&](const PlannedScene& planned) { return !is_up_to_date(planned, options_); }));
    const size_t jobs = min<size_t>(options_.execution.jobs.value_or(1), to_do);

    const int code = jobs <= 1 ? in_turn() : together(jobs, to_do);
    list_.end(since(start));
    return code != 0 ? code : list_.count(scene_status::failed) > 0 ? 1 : 0;
  }

 private:
  class Together;

  int in_turn() {
    int code = 0;
    for (PlannedScene& planned : scenes_) {
      try {
        SceneOutcome outcome = code != 0                          ? without_run(planned, scene_status::not_run)
                               : is_up_to_date(planned, options_) ? run_up_to_date(planned, options_)
                                                                  : run(planned, true, nullptr);

        if (names_full_disk(outcome.complaint)) code = 1;
        list_.add(std::move(outcome));
      } catch (const Interrupted& signal) {
        list_.add(run_interrupted(planned));
        code = signal.exit_code();
      }
      planned.scene.reset();  // the next one may need the memory
    }
    return code;
  }

  int together(size_t jobs, size_t to_do);

  /// `done`: where the fraction done is stored (Progress::share). May throw Interrupted.
  SceneOutcome run(const PlannedScene& planned, bool shown, std::atomic<double>* done) const {
    Progress progress(options_, label(planned), shown);
    progress.share(done);
    progress.expect(run_ahead(planned));
    return work_(planned, progress);
  }

  /// "2/3 two_bowling_balls", or the name alone.
  string label(const PlannedScene& planned) const {
    const auto number = size_t(&planned - scenes_.data()) + 1;
    const string name = printable(planned.name);
    return scenes_.size() == 1 ? name : fmt::format("{}/{} {}", number, scenes_.size(), name);
  }

  const Options& options_;
  vector<PlannedScene>& scenes_;
  const SceneWork& work_;
  OutcomeList list_{options_};
};

/// Runs scenes in separate processes.
class Batch::Together {
 public:
  Together(Batch& batch, size_t to_do)
      : batch_(batch),
        scenes_(batch.scenes_),
        to_do_(to_do),
        outcomes_(scenes_.size()),
        fractions_(scenes_.size()),
        progress_(batch.options_, batch.options_.command) {
    progress_.begin_early();
  }

  int go(size_t jobs) {
    Tasks tasks;
    tasks.next = [this] { return next(); };
    tasks.work = [this](size_t i) { return packed(batch_.run(scenes_[i], false, fractions_.at(i))); };
    tasks.done = [this](const TaskOutcome& outcome) { take(outcome); };
    tasks.stop_check = [this] {
      stop_if_interrupted();
      show_progress();
    };
    share_processors(jobs);

    int code = 0;
    try {
      work_off(tasks, jobs);
      if (disk_is_full_) code = 1;
    } catch (const Interrupted& signal) {
      for (size_t i = settled_; i < begun_; ++i)
        if (!outcomes_[i]) outcomes_[i] = run_interrupted(scenes_[i]);
      code = signal.exit_code();
    }

    for (size_t i = begun_; i < outcomes_.size(); ++i) outcomes_[i] = without_run(scenes_[i], scene_status::not_run);
    settle_in_order();
    return code;
  }

 private:
  optional<size_t> next() {
    if (disk_is_full_) return nullopt;
    for (; begun_ < scenes_.size() && is_up_to_date(scenes_[begun_], batch_.options_); ++begun_)
      outcomes_[begun_] = run_up_to_date(scenes_[begun_], batch_.options_);
    return begun_ < scenes_.size() ? optional(begun_++) : nullopt;
  }

  void take(const TaskOutcome& outcome) {
    outcomes_[outcome.task] = outcome.kind == TaskOutcome::Kind::done ? unpacked(outcome.text)
                                                                      : run_failed(scenes_[outcome.task], outcome.text);
    if (names_full_disk(outcomes_[outcome.task]->complaint)) {
      // Scenes that run at the same time fail with the same error.
      if (disk_is_full_) outcomes_[outcome.task] = without_run(scenes_[outcome.task], scene_status::not_run);
      disk_is_full_ = true;
    }

    if (std::atomic<double>* done = fractions_.at(outcome.task)) *done = 1;
    ++finished_;
    settle_in_order();
    show_progress();
  }

  void show_progress() {
    const auto to_do = double(to_do_);
    progress_.update(max(fractions_.sum(), double(finished_)) / to_do,
                     fmt::format("{} of {} scenes", finished_, to_do_));
  }

  void settle_in_order() {
    for (; settled_ < outcomes_.size() && outcomes_[settled_]; ++settled_) {
      progress_.clear();
      batch_.list_.add(*exchange(outcomes_[settled_], SceneOutcome{}));
    }
  }

  Batch& batch_;
  const vector<PlannedScene>& scenes_;
  const size_t to_do_;  // scenes that are not up to date
  size_t begun_ = 0, finished_ = 0, settled_ = 0;
  bool disk_is_full_ = false;                // no further scene begins
  vector<optional<SceneOutcome>> outcomes_;  // by scene
  SharedFractions fractions_;                // by scene
  Progress progress_;
};

int Batch::together(size_t jobs, size_t to_do) {
  return Together(*this, to_do).go(jobs);
}

}  // namespace

int run_planned(const Options& options, vector<PlannedScene> scenes, const SceneWork& work) {
  refuse_other_content(scenes, options);
  if (const string errors = error_count(scenes); !errors.empty()) return refuse(options, scenes, errors);

  for (const PlannedScene& planned : scenes)
    for (const string& note : planned.notes) remark(options, fmt::format("{}: {}", printable(planned.file), note));
  return Batch(options, scenes, work).go();
}

int run_planned(const Options& options, vector<PlannedScene> scenes) {
  return run_planned(options, std::move(scenes), [&](const PlannedScene& planned, Progress& progress) {
    return run_one(planned, options, progress);
  });
}

}  // namespace carom
