// Scenes run in turn, or in up to --jobs processes (study/workers.h). Finished ones are kept until those before them
// are printed, so that the output has the order of the scenes.
#include "commands/batch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "commands/interrupt.h"
#include "commands/progress.h"
#include "commands/shared_fractions.h"
#include "files/failed_run.h"
#include "files/processors.h"
#include "scene/scene.h"
#include "std.h"
#include "study/workers.h"

namespace carom {
namespace {

int run_in_turn(const Batch& batch, vector<PlannedScene>& scenes, const Options& options) {
  int code = 0;
  for (PlannedScene& planned : scenes) {
    try {
      SceneOutcome outcome = code != 0                      ? without_run(planned, scene_status::not_run)
                             : batch.is_up_to_date(planned) ? batch.up_to_date(planned)
                                                            : batch.run(planned, progress_choice(options), nullptr);

      if (names_full_disk(outcome.complaint)) code = 1;
      batch.settle(std::move(outcome));
    } catch (const Interrupted& signal) {
      batch.settle(run_interrupted(planned));
      code = signal.exit_code();
    }
    planned.scene.reset();  // the next one may need the memory
  }
  return code;
}

/// Runs scenes in separate processes.
class Together {
 public:
  Together(const Batch& batch, const vector<PlannedScene>& scenes, const Options& options, string_view command,
           size_t to_do)
      : batch_(batch),
        scenes_(scenes),
        to_do_(to_do),
        outcomes_(scenes.size()),
        fractions_(scenes.size()),
        progress_(progress_choice(options), uses_color(options.color, STDERR_FILENO), string(command)) {
    progress_.begin_early();
  }

  int go(size_t jobs) {
    Tasks tasks;
    tasks.next = [this] { return next(); };
    tasks.work = [this](size_t i) { return packed(batch_.run(scenes_[i], ProgressChoice::none, fractions_.at(i))); };
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
    for (; begun_ < scenes_.size() && batch_.is_up_to_date(scenes_[begun_]); ++begun_)
      outcomes_[begun_] = batch_.up_to_date(scenes_[begun_]);
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
    const auto to_do = static_cast<double>(to_do_);
    progress_.update(std::max(fractions_.sum(), static_cast<double>(finished_)) / to_do,
                     fmt::format("{} of {} scenes", finished_, to_do_));
  }

  void settle_in_order() {
    for (; settled_ < outcomes_.size() && outcomes_[settled_]; ++settled_) {
      progress_.clear();
      batch_.settle(*std::exchange(outcomes_[settled_], SceneOutcome{}));
    }
  }

  const Batch& batch_;
  const vector<PlannedScene>& scenes_;
  const size_t to_do_;  // scenes that are not up to date
  size_t begun_ = 0, finished_ = 0, settled_ = 0;
  bool disk_is_full_ = false;                // no further scene begins
  vector<optional<SceneOutcome>> outcomes_;  // by scene
  SharedFractions fractions_;                // by scene
  Progress progress_;
};

}  // namespace

int run_batch(const Batch& batch, vector<PlannedScene>& scenes, const Options& options, string_view command) {
  const auto to_do = static_cast<size_t>(
      std::ranges::count_if(scenes, [&](const PlannedScene& planned) { return !batch.is_up_to_date(planned); }));
  const size_t jobs = std::min<size_t>(options.execution.jobs.value_or(1), to_do);
  if (jobs <= 1) return run_in_turn(batch, scenes, options);
  return Together(batch, scenes, options, command, to_do).go(jobs);
}

}  // namespace carom
