// One way through a run: a simulation, and a rendering of its record.
// - The simulator advances once, on the caller's thread. Tables and measures are taken as it goes.
// - Whatever is drawn follows the record by a Replay, on a thread of its own. If the drawings need something of the
//   whole motion first, such as a camera that frames it or the run's end, the record goes to a file, which is
//   flights.bin where the run keeps it, and drawing begins at the end. Otherwise it goes through a queue, and both go
//   on together.
// At the end every folder gets its summary and its manifest, and its files get their final names.
#include "run/run_scene.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "export/flights_file.h"
#include "files/manifest.h"
#include "run/account.h"
#include "run/drawing_thread.h"
#include "run/record_queue.h"
#include "run/replay.h"
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

/// Passes the record of a motion on.
class RecordSink final : public MotionSink {
 public:
  explicit RecordSink(std::function<void(const Simulator&)> put) : put_(std::move(put)) {}

  bool more() const override { return false; }
  double time() override { return std::numeric_limits<double>::infinity(); }
  void record(const Simulator& simulator) override { put_(simulator); }
  void sample(Simulator&) override {}
  void end_at(double) override {}

 private:
  std::function<void(const Simulator&)> put_;
};

/// Whether something that the scene requests is spread over the whole run, which may end early.
bool needs_end(const Scene& scene) {
  const auto whole = [](const Output& output) { return output.plots || (output.sheet && !output.sheet->until); };
  return may_stop(scene) && (whole(scene.output) || whole(scene.requested));
}

class Run {
 public:
  Run(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch)
      : shows_(shows.begin(), shows.end()),
        settings_(settings),
        watch_(watch),
        engine_(engine),
        stages_(shows.size()),
        failures_(shows.size()) {
    for (std::size_t i = 0; i < shows_.size(); ++i) guarded(i, [&] { open(i); });

    const Stopwatch stopwatch(simulate_s_);
    if (!settings.replay) settle_steps(scene(), engine_, watch.stop_check);
    Recording recording = recording_of_all();
    simulator_ = settings.replay ? settings.replay(scene())
                                 : settings.simulator(scene(), std::move(recording), engine_.steps);
    start_ = stored_energy(scene(), simulator_->state());
  }

  void go() {
    if (!draws()) return simulate(nullptr);
    if (!settings_.replay) return waits() ? simulate_then_draw() : simulate_and_draw();
    simulate(nullptr);
    draw_by([this] { return settings_.replay(scene()); });
  }

  std::vector<RunResult> finish() {
    std::vector<RunResult> results(shows_.size());
    for (std::size_t i = 0; i < shows_.size(); ++i) {
      guarded(i, [&] { finish(i, results[i]); });
      results[i].failure = failures_[i];
    }
    return results;
  }

 private:
  using MakeMotion = std::function<std::unique_ptr<Simulator>()>;

  // All shows have the same motion.
  const Scene& scene() const { return *shows_.front().scene; }

  /// A failure of one of several shows does not affect the others.
  template <typename Work>
  void guarded(std::size_t i, const Work& work) {
    if (has_failed(i)) return;
    try {
      work();
    } catch (const std::exception&) {
      // ffmpeg also receives a Ctrl-C and ends first. What looks like a write error is then the interrupt.
      watch_.stop_check();
      if (shows_.size() == 1) throw;
      const std::lock_guard lock(failing_);
      failures_[i] = std::current_exception();
    }
  }

  bool has_failed(std::size_t i) {
    const std::lock_guard lock(failing_);
    return failures_[i] != nullptr;
  }

  /// Opens the folder of a show. The end of its run may become known later.
  void open(std::size_t i) {
    Show& show = shows_[i];
    check_flights(*show.scene);
    if (needs_end(*show.scene)) show.scene = &ending_.emplace_back(*show.scene);
    stages_[i] = std::make_unique<Stage>(show, settings_.durability, measures_of(*show.scene));
  }

  /// The measures of a scene and those of the settings, unless a former run has them.
  std::vector<Measure> measures_of(const Scene& of) const {
    if (settings_.former != nullptr) return {};
    std::vector<Measure> measures = own_measures(of);
    measures.insert(measures.end(), settings_.measures.begin(), settings_.measures.end());
    return measures;
  }

  Recording recording_of_all() {
    Recording recording;
    for (const auto& stage : stages_) {
      first_watched_.push_back(recording.watch.size());
      if (!stage) continue;
      const Scene& of = stage->scene;
      const bool draws = stage->exports.draws();
      recording.collisions = recording.collisions || of.output.needs_collisions() ||
                             stage->measuring.needs_collisions() || (draws && drawings_show_collisions(of));
      recording.paths = recording.paths || of.output.flights || draws;
      const std::vector<WatchedQuantity>& watched = stage->measuring.watched();
      recording.watch.insert(recording.watch.end(), watched.begin(), watched.end());
    }
    return recording;
  }

  bool draws() {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      if (!has_failed(i) && stages_[i]->exports.draws()) return true;
    return false;
  }

  /// Whether drawings need to know more of the motion than the present.
  bool waits() const {
    return std::ranges::any_of(shows_,
                               [](const Show& show) { return may_stop(*show.scene) || frames_motion(*show.scene); });
  }

  /// Advances the simulator through the whole run. `record` also takes the motion, if it is not null.
  void simulate(
      MotionSink* record, const std::function<void()>& check = [] {}) {
    std::vector<MotionSink*> sinks;
    std::vector<std::size_t> show_of;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      if (has_failed(i)) continue;
      sinks.push_back(&stages_[i]->tables);
      show_of.push_back(i);
    }
    if (record != nullptr) sinks.push_back(record);

    carry_through(*simulator_, sinks, scene().simulate.duration,
                  [&](std::size_t sink, const std::function<void()>& work) {
                    sink < show_of.size() ? guarded(show_of[sink], work) : work();
                  },
                  {.stop_check =
                       [&] {
                         watch_.stop_check();
                         check();
                       },
                   .advanced = [this](const Simulator&) { report_progress(); },
                   .advance_s = &simulate_s_});

    simulator_->state();
    for (std::size_t i = 0; i < stages_.size(); ++i)
      guarded(i, [&] { stages_[i]->exports.tables().end(simulator_->tally()); });
  }

  /// Draws while the simulator advances.
  void simulate_and_draw() {
    begin_drawings();
    RecordQueue queue;
    DrawingThread drawing([&] {
      try {
        draw_all([&] {
          return std::make_unique<Replay>(
              scene().world, [&queue](Recorded& recorded) { return queue.next(recorded); }, Tally{}, true);
        });
      } catch (const RecordAbandoned&) {
      } catch (...) {
        queue.leave();
        throw;
      }
      queue.leave();
    });
    if (!drawing.is_there()) return simulate_then_draw();

    try {
      RecordSink sink([&queue](const Simulator& simulator) { queue.put(simulator); });
      simulate(&sink, [&drawing] { drawing.check(); });
    } catch (...) {
      queue.end(false);
      throw;
    }
    queue.end(true);
    drawing.wait([this] { watch_while_drawing(); });
    end_drawings();
  }

  /// Draws once the whole motion is recorded.
  void simulate_then_draw() {
    FlightsFile* record = shows_.size() == 1 ? stages_.front()->exports.flights() : nullptr;
    std::optional<FlightsFile> own;
    std::optional<RecordSink> sink;
    if (record != nullptr) {
      record->keep_whole();
    } else {
      record = &own.emplace(place_of_record(), scene(), FlightsFile::nameless);
      sink.emplace([record](const Simulator& simulator) {
        record->record(simulator.collisions());
        record->record_paths(simulator.paths());
      });
    }

    simulate(sink ? &*sink : nullptr);
    if (own) own->end(simulator_->tally());
    if (const std::optional<RunEnd>& end = simulator_->tally().end; end && end->time < scene().simulate.duration)
      for (Scene& ending : ending_) ending.ends_at = end->time;
    draw_by([this, record] {
      const auto reader = std::make_shared<FlightsReader>(record->reopened(), "", scene());
      return std::make_unique<Replay>(
          scene().world, [reader](Recorded& recorded) { return reader->next(recorded); }, reader->tally(),
          reader->has_collisions());
    });
  }

  /// The folder of the first show that is there.
  const FilePlace& place_of_record() {
    std::size_t first = 0;
    while (has_failed(first)) ++first;
    return stages_[first]->exports.place();
  }

  /// Draws by recorded motions, on a thread of its own if there is one.
  void draw_by(const MakeMotion& motion) {
    begin_drawings();
    DrawingThread drawing([&] { draw_all(motion); });
    if (drawing.is_there())
      drawing.wait([this] { watch_while_drawing(); });
    else
      draw_all(motion);
    end_drawings();
  }

  void begin_drawings() {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      guarded(i, [&] {
        if (stages_[i]->exports.draws() && !stages_[i]->drawings) stages_[i]->begin_drawings(watch_.stop_check);
      });
  }

  /// Frames the motion where cameras do that, and draws everything.
  void draw_all(const MakeMotion& motion) {
    std::vector<MotionSink*> sinks;
    std::vector<std::size_t> show_of;
    std::vector<MovingCamera*> framing;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      if (has_failed(i) || !stages_[i]->drawings) continue;
      sinks.push_back(&*stages_[i]->drawings);
      show_of.push_back(i);
      for (MovingCamera* camera : stages_[i]->drawings->cameras())
        if (camera->frames_motion()) framing.push_back(camera);
    }
    if (!framing.empty()) survey(framing, *motion(), watch_.stop_check);

    const std::unique_ptr<Simulator> simulator = motion();
    carry_through(*simulator, sinks, scene().simulate.duration,
                  [&](std::size_t sink, const std::function<void()>& work) { guarded(show_of[sink], work); },
                  {.stop_check = watch_.stop_check, .advanced = [](const Simulator&) {}});
  }

  void end_drawings() {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      guarded(i, [&] {
        if (stages_[i]->drawings) stages_[i]->exports.drawings().end(simulator_->tally());
      });
  }

  void watch_while_drawing() const {
    watch_.stop_check();
    report_progress();
  }

  void report_progress() const {
    std::uint64_t pictures = 0;
    for (const auto& stage : stages_)
      if (stage) pictures += stage->exports.frames();
    watch_.report_progress(simulator_->time(), simulator_->tally().collisions(), pictures);
  }

  void finish(std::size_t i, RunResult& result) {
    Stage& stage = *stages_[i];
    const State& end = simulator_->state();
    result.engine = engine_;
    result.summary = account_of(stage.scene, engine_, start_, end, simulator_->tally());
    result.summary.warnings = settings_.former != nullptr
                                  ? settings_.former->warnings
                                  : warnings_of(stage.scene, engine_, end, result.summary, simulator_->tally());
    result.summary.status = result.summary.warnings.empty() ? "done" : "doubtful";
    result.summary.frames = stage.exports.frames();

    result.facts = stage.facts();
    result.facts.simulate_s = simulate_s_;
    result.facts.peak_memory = peak_memory();
    result.facts.left_out = stage.exports.left_out();
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
  std::deque<Scene> ending_;  // those of shows that wait for the run's end
  const RunSettings& settings_;
  const RunWatch& watch_;
  EngineChoice engine_;
  // By show. It is null, or not used any more, where the show has failed.
  std::vector<std::unique_ptr<Stage>> stages_;
  std::mutex failing_;
  std::vector<std::exception_ptr> failures_;  // by show
  std::unique_ptr<Simulator> simulator_;
  std::vector<std::size_t> first_watched_;  // by show: the first of its quantities among all that are watched
  StoredEnergy start_;                      // at time 0
  double simulate_s_ = 0;                   // wall time
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
