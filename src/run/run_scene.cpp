// The loop of a run: advance the simulator to the next instant of the timelines, then write and draw what is due.
// At the end every folder gets its summary and its manifest, and its files get their final names.
#include "run/run_scene.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "files/manifest.h"
#include "run/account.h"
#include "run/stopwatch.h"
#include "run/survey.h"
#include "run/warnings.h"
#include "scene/scene.h"

namespace carom {
namespace {

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

class Run {
 public:
  Run(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch)
      : shows_(shows.begin(), shows.end()),
        settings_(settings),
        watch_(watch),
        engine_(engine),
        results_(shows.size()) {
    if (std::any_of(shows_.begin(), shows_.end(), [](const Show& show) { return needs_end(*show.scene); })) find_end();
    for (std::size_t i = 0; i < shows_.size(); ++i) {
      stages_.emplace_back();
      guarded(i, [&] {
        check_flights(*shows_[i].scene);
        stages_[i] = std::make_unique<Stage>(shows_[i], settings.durability, measures_of(*shows_[i].scene));
      });
    }
    const Stopwatch stopwatch(simulate_s_);
    settle();
    frame_motion();
    Recording recording;
    for (const Show& show : shows_) {
      const OverlayNeeds needs = overlay_needs(*show.scene);
      recording.collisions = recording.collisions || show.scene->output.needs_collisions() || needs.collisions;
      recording.paths = recording.paths || show.scene->output.flights || needs.paths;
    }
    for (const auto& stage : stages_) {
      first_watched_.push_back(recording.watch.size());
      if (!stage) continue;
      recording.collisions = recording.collisions || stage->measuring.needs_collisions();
      const std::vector<WatchedQuantity>& watched = stage->measuring.watched();
      recording.watch.insert(recording.watch.end(), watched.begin(), watched.end());
    }
    simulator_ = settings.simulator ? settings.simulator(scene()) : make_simulator(scene(), recording, engine_.steps);
    record();
    start_ = stored_energy(scene(), simulator_->state());
  }

  void go() {
    while (const std::optional<double> time = next_instant()) {
      carry_to(*time);
      if (const std::optional<RunEnd>& end = simulator_->tally().end; end && !ended_ && !(*time < end->time)) {
        end_at(end->time);
        continue;
      }
      for (std::size_t i = 0; i < stages_.size(); ++i) {
        if (stages_[i] && stages_[i]->more && stages_[i]->time() <= *time)
          guarded(i, [&] { stages_[i]->sample(*simulator_, {watch_.stop_check, [this] { report_progress(); }}); });
      }
    }
  }

  std::vector<RunResult> finish() {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      if (stages_[i]) guarded(i, [&] { finish(i); });
    return std::move(results_);
  }

 private:
  /// The measures of a scene and those of the settings, unless a former run has them.
  std::vector<Measure> measures_of(const Scene& of) const {
    if (settings_.former != nullptr) return {};
    std::vector<Measure> measures = own_measures(of);
    measures.insert(measures.end(), settings_.measures.begin(), settings_.measures.end());
    return measures;
  }

  // All shows have the same motion.
  const Scene& scene() const { return *shows_.front().scene; }

  void settle() {
    if (!settings_.simulator && !std::exchange(settled_, true)) settle_steps(scene(), engine_, watch_.stop_check);
  }

  std::unique_ptr<Simulator> make_ahead() const {
    return settings_.simulator ? settings_.simulator(scene()) : make_simulator(scene(), {}, engine_.steps);
  }

  void watch_ahead() const {
    watch_.stop_check();
    watch_.report_progress(0, 0, 0);
  }

  /// Whether something that the scene requests is spread over the whole run, which may end early.
  static bool needs_end(const Scene& scene) {
    const auto whole = [](const Output& output) { return output.plots || (output.sheet && !output.sheet->until); };
    return may_stop(scene) && (whole(scene.output) || whole(scene.requested));
  }

  /// Finds the end of a run that stops early, by a simulation in advance, and gives it to the scenes.
  void find_end() {
    const Stopwatch stopwatch(simulate_s_);
    settle();
    const auto ahead = make_ahead();
    const double duration = scene().simulate.duration;
    if (!ahead->tally().end) carry_ahead(*ahead, duration);
    const std::optional<RunEnd> end = ahead->tally().end;
    if (!end || !(end->time < duration)) return;
    for (Show& show : shows_) {
      ending_.push_back(*show.scene);
      ending_.back().ends_at = end->time;
      show.scene = &ending_.back();
    }
  }

  /// The errors of the run itself come later.
  void carry_ahead(Simulator& ahead, double duration) const {
    try {
      carom::carry_to(ahead, duration, duration, [this] { watch_ahead(); });
    } catch (const SimulationError&) {
    }
  }

  /// Gives the cameras that frame the motion what they need, by a simulation in advance.
  void frame_motion() {
    std::vector<MovingCamera*> cameras;
    for (const auto& stage : stages_) {
      if (!stage) continue;
      for (MovingCamera* camera : stage->cameras())
        if (camera->frames_motion()) cameras.push_back(camera);
    }
    if (cameras.empty()) return;
    const auto ahead = make_ahead();
    survey(cameras, *ahead, [this] { watch_ahead(); });
  }

  /// A failure of one of several shows does not affect the others.
  template <typename Work>
  void guarded(std::size_t i, const Work& work) {
    try {
      work();
    } catch (const std::exception&) {
      // ffmpeg also receives a Ctrl-C and ends first. What looks like a write error is then the interrupt.
      watch_.stop_check();
      if (shows_.size() == 1) throw;
      results_[i].failure = std::current_exception();
      stages_[i].reset();
    }
  }

  std::optional<double> next_instant() const {
    std::optional<double> next;
    for (const auto& stage : stages_)
      if (stage && stage->more) next = std::min(next.value_or(stage->time()), stage->time());
    return next;
  }

  // Advances in slices, so that signals and progress are handled where no output is due for long.
  // Sampling changes nothing in the simulator, so the slices do not change the motion by a bit.
  void carry_to(double time) {
    const double slice = scene().simulate.duration / 1000;
    // A known end is the run's own only when it has been found again, which may take a moment more.
    if (scene().ends_at && !(time < *scene().ends_at)) time = scene().simulate.duration;
    watch_.stop_check();
    while (simulator_->time() < time && !is_over()) {
      const double before = simulator_->time();
      const std::uint64_t collisions_before = simulator_->tally().collisions();
      // Multiples of the slice, so that round instants stay round.
      double slices = std::floor(before / slice) + 1;
      if (!(slices * slice > before)) ++slices;
      const double next = std::min(time, slices * slice);
      {
        const Stopwatch watch(simulate_s_);
        simulator_->advance_to(next > before ? next : time);
      }
      if (!record() && !(simulator_->time() > before) && simulator_->tally().collisions() == collisions_before &&
          !is_over())
        throw SimulationError("the simulator makes no progress");
      watch_.stop_check();
      report_progress();
    }
  }

  /// Whether the run has ended before its duration.
  bool is_over() const {
    const std::optional<RunEnd>& end = simulator_->tally().end;
    return end && !(simulator_->time() < end->time);
  }

  void end_at(double time) {
    ended_ = true;
    for (std::size_t i = 0; i < stages_.size(); ++i)
      if (stages_[i]) guarded(i, [&] { stages_[i]->end_at(time); });
  }

  /// Returns whether there was anything to record.
  bool record() {
    const std::span<const RegionCrossing> crossings = simulator_->crossings();
    if (simulator_->collisions().empty() && simulator_->paths().empty() && crossings.empty()) return false;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      if (!stages_[i]) continue;
      guarded(i, [&] {
        const Stopwatch watch(stages_[i]->facts.export_s);
        stages_[i]->record(*simulator_);
      });
    }
    return true;
  }

  void report_progress() const {
    std::uint64_t pictures = 0;
    for (const auto& stage : stages_)
      if (stage) pictures += stage->exports.frames();
    watch_.report_progress(simulator_->time(), simulator_->tally().collisions(), pictures);
  }

  void finish(std::size_t i) {
    Stage& stage = *stages_[i];
    RunResult& result = results_[i];
    const State& end = simulator_->state();
    result.engine = engine_;
    result.summary = account_of(stage.scene, engine_, start_, end, simulator_->tally());
    result.summary.warnings = settings_.former != nullptr
                                  ? settings_.former->warnings
                                  : warnings_of(stage.scene, engine_, end, result.summary, simulator_->tally());
    result.summary.status = result.summary.warnings.empty() ? "done" : "doubtful";
    result.summary.frames = stage.exports.frames();
    result.facts = stage.facts;
    result.facts.simulate_s = simulate_s_;
    result.facts.peak_memory = peak_memory();
    result.facts.left_out = stage.exports.end(simulator_->tally());
    take_measures(i, end, result);
    stage.exports.finish(result.summary, result.facts);
  }

  void take_measures(std::size_t i, const State& end, RunResult& result) const {
    const Stage& stage = *stages_[i];
    if (const Manifest* former = settings_.former; former != nullptr) {
      if (result.summary.collisions != former->collisions)
        throw ExportError(
            fmt::format("the motion differs: {} collisions, not {}", result.summary.collisions, former->collisions));
      result.facts.measures = former->measures;
    } else {
      const std::vector<Extremes> all = simulator_->extremes();
      const auto own = std::span(all).subspan(first_watched_[i], stage.measuring.watched().size());
      result.facts.measures = stage.measuring.values({end, result.summary, own});
    }
    for (const OwnMeasure& own : stage.scene.measures.own)
      for (const Measured& measured : result.facts.measures)
        if (measured.name == own.name) result.summary.measures.push_back(measured);
  }

  std::vector<Show> shows_;
  std::deque<Scene> ending_;  // those of shows of a run that is known to end early
  const RunSettings& settings_;
  const RunWatch& watch_;
  EngineChoice engine_;
  std::vector<RunResult> results_;  // by show
  /// By show. Null: it has failed.
  std::vector<std::unique_ptr<Stage>> stages_;
  std::unique_ptr<Simulator> simulator_;
  std::vector<std::size_t> first_watched_;  // by show: the first of its quantities among all that are watched
  StoredEnergy start_;                      // at time 0
  double simulate_s_ = 0;                   // wall time
  bool settled_ = false, ended_ = false;    // the steps; the timelines
};

}  // namespace

std::vector<RunResult> run_shows(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings,
                                 const RunWatch& watch) {
  double wall_s = 0;
  std::vector<RunResult> results;
  {
    const Stopwatch wall(wall_s);
    try {
      Run run(shows, engine, settings, watch);
      run.go();
      results = run.finish();
    } catch (const SimulationError& error) {
      const Roster& roster = shows.front().scene->roster;
      throw error.named([&](Entity body) { return fmt::format("`{}`", roster.name(body)); });
    }
  }
  for (RunResult& result : results) result.wall_s = wall_s;
  return results;
}

RunResult run_scene(const Show& show, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch) {
  return std::move(run_shows({&show, 1}, engine, settings, watch).front());
}

}  // namespace carom
