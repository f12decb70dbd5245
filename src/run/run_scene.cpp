// One way through a run: a simulation, and a rendering of its record.
// - The simulator advances once, on the caller's thread. Tables and measures are taken as it goes.
// - Whatever is drawn follows the record by a Replay, on a thread of its own. If the drawings need something of the
//   whole motion first, such as a camera that frames it or the run's end, the record goes to a file, which is
//   flights.bin where the run keeps it, and drawing begins at the end. Otherwise it goes through a queue, and both go
//   on together.
// At the end every folder gets its summary and its manifest, and its files get their final names.
//
// A run that goes on after an interrupt (checkpoints.h) draws when its motion is over, because the record has all that
// is drawn.
#include "run/run_scene.h"

#include <fmt/format.h>

#include "engine/accuracy.h"
#include "export/flights_file.h"
#include "physics/archive.h"
#include "run/checkpoints.h"
#include "run/drawing_thread.h"
#include "run/drawings.h"
#include "run/motion_record.h"
#include "run/record_queue.h"
#include "run/replay.h"
#include "run/stopwatch.h"
#include "run/survey.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

class Run {
 public:
  Run(span<const Show> shows, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch)
      : scene_(*shows.front().scene),
        settings_(settings),
        watch_(watch),
        stages_(shows, settings, watch.stop_check),
        checkpoints_(stages_, simulated_, settings, watch),
        drawings_(stages_, scene_, watch.stop_check) {
    simulated_.engine = engine;
    if (stages_.have_drawings() && !settings.replay && draws_by_record()) open_record();
    if (checkpoints_.goes_on())
      checkpoints_.take_over([this](const StepChoice& steps) { return simulator_by(steps); });
    else
      begin();
  }

  /// Wall time (s) of the simulation so far, if an interrupted run goes on.
  double before_s() const { return checkpoints_.goes_on() ? simulated_.simulate_s : 0; }

  void go() {
    if (!stages_.have_drawings()) return simulate({});
    if (!settings_.replay) return draws_by_record() ? simulate_then_draw() : simulate_and_draw();
    simulate({});
    draw_by([this] { return settings_.replay(scene_); }, false);
  }

  vector<RunResult> finish() {
    report_progress(RunProgress::Phase::writing);
    return stages_.finish(simulated_);
  }

 private:
  const Tally& tally() const { return simulated_.simulator->tally(); }

  unique_ptr<Simulator> simulator_by(const StepChoice& steps) {
    return settings_.replay ? settings_.replay(scene_) : settings_.simulator(scene_, stages_.recording(), steps);
  }

  void begin() {
    const Stopwatch stopwatch(simulated_.simulate_s);
    if (!settings_.replay && scene_.simulate.tolerance) {
      watch_.report_progress({RunProgress::Phase::settling});
      settle_steps(scene_, simulated_.engine, watch_.stop_check);
    }
    simulated_.simulator = simulator_by(simulated_.engine.steps);
    simulated_.start = stored_energy(scene_, simulated_.simulator->state());
  }

  /// Whether drawings follow a record in a file.
  bool draws_by_record() { return checkpoints_.goes_on() || stages_.draw_after_motion(); }

  /// Opens the record that drawings follow: the flights of the only folder, or a file of its own. It has a name where
  /// the run goes on by it after an interrupt.
  void open_record() {
    const vector<Stages::Standing> standing = stages_.standing();
    const Exports& exports = standing.front().stage->exports;
    if (standing.size() == 1) record_ = standing.front().stage->exports.flights();
    if (record_ != nullptr) return;

    if (stages_.lasting() != nullptr)
      own_record_.emplace(exports.place(), scene_);
    else
      own_record_.emplace(exports.place(), scene_, FlightsFile::nameless);
    record_ = &*own_record_;
    checkpoints_.add(*own_record_);
  }

  /// Advances the simulator through the whole run. `others` also take the motion. `check` is called often.
  void simulate(
      vector<MotionSink*> others, const function<void()>& check = [] {}) {
    optional<RecordSink> own;
    if (own_record_) others.push_back(&own.emplace(record_into(*own_record_, scene_.simulate.duration)));
    const vector<Stages::Standing> standing = stages_.standing();
    vector<MotionSink*> sinks;
    for (const Stages::Standing& each : standing) sinks.push_back(&each.stage->tables);
    sinks.insert(sinks.end(), others.begin(), others.end());

    const SinkGuard guard = [&](size_t sink, const function<void()>& work) {
      sink < standing.size() ? stages_.guarded(standing[sink].show, work) : work();
    };

    const auto stop_check = [&] {
      try {
        watch_.stop_check();
        check();
      } catch (...) {
        keep_at_interrupt();
        throw;
      }
    };

    const auto advanced = [this] {
      report_progress(RunProgress::Phase::simulating);
      checkpoints_.keep_if_due();
    };

    try {
      carry_through(*simulated_.simulator, sinks, scene_.simulate.duration, guard,
                    {.stop_check = stop_check,
                     .advanced = advanced,
                     .advance_s = &simulated_.simulate_s,
                     .goes_on = checkpoints_.goes_on()});
    } catch (const SimulationError&) {
      // The same would happen again.
      checkpoints_.forget();
      throw;
    }
    if (stages_.have_drawings()) checkpoints_.keep_again();

    simulated_.simulator->state();  // the tally's sums are then those of the end
    stages_.each([this](Stage& stage) { stage.exports.tables().end(tally()); });
    if (own_record_) own_record_->end(tally());
  }

  /// An error leaves what was kept before.
  void keep_at_interrupt() {
    try {
      checkpoints_.keep_again();
    } catch (const ExportError&) {
    }
  }

  /// Draws while the simulator advances.
  void simulate_and_draw() {
    stages_.begin_drawings();
    RecordQueue queue;
    DrawingThread drawing([&] { drawings_.follow(queue); });
    if (!drawing.is_there()) {
      open_record();
      return simulate_then_draw();
    }

    try {
      RecordSink sink(scene_.simulate.duration, [&queue](const Simulator& simulator) { queue.put(simulator); });
      simulate({&sink}, [&drawing] { drawing.check(); });
    } catch (...) {
      queue.end(false);
      throw;
    }
    queue.end(true);
    drawing.wait([this] { watch_while_drawing(); });
    drawings_.end(tally());
  }

  /// Draws once the whole motion is recorded.
  void simulate_then_draw() {
    record_->keep_whole();
    vector<MotionSink*> sinks;

    // Where nothing is awaited, the instants of the pictures are known, and cameras and charts take them on the way.
    optional<Framing> framing;
    optional<Charting> charting;
    if (!may_stop(scene_) && !stages_.await_motion() && !checkpoints_.goes_on()) {
      stages_.begin_drawings();
      framing.emplace(drawings_.framing_cameras());
      charting.emplace(drawings_.charts());
      if (framing->any()) sinks.push_back(&*framing);
      if (charting->any()) sinks.push_back(&*charting);
    }

    simulate(sinks);
    drawings_.prepare([&] {
      if (framing) framing->finish();
      if (charting) charting->finish();
    });
    const auto motion = [this] {
      return replay_from(make_unique<FlightsReader>(record_->reopened(), "", scene_), scene_.world);
    };
    draw_by(motion, framing.has_value());
  }

  /// Draws by recorded motions, on a thread of its own if there is one. surveyed: cameras and charts have been given
  /// the motion.
  void draw_by(const MakeMotion& motion, bool surveyed) {
    stages_.take_motion(tally().end, motion);
    stages_.begin_drawings();
    const auto draw = [&] { drawings_.draw(motion, surveyed); };
    DrawingThread drawing(draw);
    if (drawing.is_there())
      drawing.wait([this] { watch_while_drawing(); });
    else
      draw();
    drawings_.end(tally());
  }

  void watch_while_drawing() const {
    watch_.stop_check();
    report_progress(RunProgress::Phase::drawing);
  }

  void report_progress(RunProgress::Phase phase) const {
    watch_.report_progress({phase, simulated_.simulator->time(), tally().collisions(), stages_.pictures(),
                            checkpoints_.begun_at(), stages_.planned_pictures()});
  }

  const Scene& scene_;  // one of those that share the motion
  const RunSettings& settings_;
  const RunWatch& watch_;
  Simulated simulated_;
  Stages stages_;
  Checkpoints checkpoints_;
  Drawings drawings_;
  optional<FlightsFile> own_record_;
  FlightsFile* record_ = nullptr;
};

}  // namespace

vector<RunResult> run_shows(span<const Show> shows, const EngineChoice& engine, const RunSettings& settings,
                            const RunWatch& watch) {
  double wall_s = 0;
  double before_s = 0;
  vector<RunResult> results;

  const auto run_all = [&] {
    Run run(shows, engine, settings, watch);
    before_s = run.before_s();
    run.go();
    results = run.finish();
  };

  {
    const Stopwatch wall(wall_s);
    try {
      try {
        run_all();
      } catch (const ArchiveError&) {
        watch.remark("begins anew: what the interrupted run in its folder has left is damaged");
        run_all();
      }
    } catch (const SimulationError& error) {
      const Roster& roster = shows.front().scene->roster;
      throw error.named([&](Entity body) { return fmt::format("`{}`", roster.name(body)); });
    }
  }

  for (RunResult& result : results) result.wall_s = before_s + wall_s;
  return results;
}

RunResult run_scene(const Show& show, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch) {
  return std::move(run_shows({&show, 1}, engine, settings, watch).front());
}

}  // namespace carom
