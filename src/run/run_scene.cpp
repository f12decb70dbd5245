// One way through a run: a simulation, and a rendering of its record.
// - The simulator advances once, on the caller's thread. Tables and measures are taken as it goes.
// - Whatever is drawn follows the record by a Replay, on a thread of its own. If the drawings need something of the
//   whole motion first, such as a camera that frames it or the run's end, the record goes to a file, which is
//   flights.bin where the run keeps it, and drawing begins at the end. Otherwise it goes through a queue, and both go
//   on together.
// At the end every folder gets its summary and its manifest, and its files get their final names.
#include "run/run_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "export/flights_file.h"
#include "run/drawing_thread.h"
#include "run/motion_record.h"
#include "run/record_queue.h"
#include "run/replay.h"
#include "run/stages.h"
#include "run/stopwatch.h"
#include "run/survey.h"
#include "scene/scene.h"

namespace carom {
namespace {

class Run {
 public:
  Run(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch)
      : scene_(*shows.front().scene),
        settings_(settings),
        watch_(watch),
        engine_(engine),
        stages_(shows, settings, watch.stop_check) {
    const Stopwatch stopwatch(simulate_s_);
    if (!settings.replay && scene_.simulate.tolerance) {
      watch.report_progress({RunProgress::Phase::settling});
      settle_steps(scene_, engine_, watch.stop_check);
    }
    simulator_ =
        settings.replay ? settings.replay(scene_) : settings.simulator(scene_, stages_.recording(), engine_.steps);
    start_ = stored_energy(scene_, simulator_->state());
  }

  void go() {
    if (!stages_.have_drawings()) return simulate({});
    if (!settings_.replay) return stages_.draw_after_motion() ? simulate_then_draw() : simulate_and_draw();
    simulate({});
    stages_.take_end(simulator_->tally().end);
    draw_by([this] { return settings_.replay(scene_); });
  }

  std::vector<RunResult> finish() {
    report_progress(RunProgress::Phase::writing);
    return stages_.finish({engine_, start_, *simulator_, simulate_s_});
  }

 private:
  using MakeMotion = std::function<std::unique_ptr<Simulator>()>;

  /// Advances the simulator through the whole run. `others` also take the motion. `check` is called often.
  void simulate(
      const std::vector<MotionSink*>& others, const std::function<void()>& check = [] {}) {
    const std::vector<Stages::Standing> standing = stages_.standing();
    std::vector<MotionSink*> sinks;
    for (const Stages::Standing& each : standing) sinks.push_back(&each.stage->tables);
    sinks.insert(sinks.end(), others.begin(), others.end());

    const SinkGuard guard = [&](std::size_t sink, const std::function<void()>& work) {
      sink < standing.size() ? stages_.guarded(standing[sink].show, work) : work();
    };
    const auto stop_check = [&] {
      watch_.stop_check();
      check();
    };
    carry_through(*simulator_, sinks, scene_.simulate.duration, guard,
                  {.stop_check = stop_check,
                   .advanced = [this] { report_progress(RunProgress::Phase::simulating); },
                   .advance_s = &simulate_s_});

    simulator_->state();  // the tally's sums are then those of the end
    stages_.each([this](Stage& stage) { stage.exports.tables().end(simulator_->tally()); });
  }

  /// Draws while the simulator advances.
  void simulate_and_draw() {
    stages_.begin_drawings();
    RecordQueue queue;
    DrawingThread drawing([&] { draw_from(queue); });
    if (!drawing.is_there()) return simulate_then_draw();

    try {
      RecordSink sink(scene_.simulate.duration, [&queue](const Simulator& simulator) { queue.put(simulator); });
      simulate({&sink}, [&drawing] { drawing.check(); });
    } catch (...) {
      queue.end(false);
      throw;
    }
    queue.end(true);
    drawing.wait([this] { watch_while_drawing(); });
    end_drawings();
  }

  void draw_from(RecordQueue& queue) {
    const auto next = [&queue](Recorded& recorded) { return queue.next(recorded); };
    try {
      draw_all([&] { return std::make_unique<Replay>(scene_.world, next, Tally{}, true); });
    } catch (const RecordAbandoned&) {
      // The simulation has failed, and its error is the run's.
    } catch (...) {
      queue.leave();
      throw;
    }
    queue.leave();
  }

  /// Draws once the whole motion is recorded.
  void simulate_then_draw() {
    const std::vector<Stages::Standing> standing = stages_.standing();
    FlightsFile* record = standing.size() == 1 ? standing.front().stage->exports.flights() : nullptr;
    std::optional<FlightsFile> own;
    std::optional<RecordSink> sink;
    std::vector<MotionSink*> sinks;
    if (record != nullptr) {
      record->keep_whole();
    } else {
      record = &own.emplace(standing.front().stage->exports.place(), scene_, FlightsFile::nameless);
      sinks.push_back(&sink.emplace(record_into(*record, scene_.simulate.duration)));
    }

    // Where the end is not awaited, the instants of the pictures are known, and cameras frame them on the way.
    if (!may_stop(scene_)) stages_.begin_drawings();
    const std::vector<MovingCamera*> cameras = framing_cameras();
    Framing framing(cameras);
    if (framing.any()) sinks.push_back(&framing);

    simulate(sinks);
    framing.finish();
    if (own) own->end(simulator_->tally());
    stages_.take_end(simulator_->tally().end);
    draw_by(
        [this, record] {
          return replay_from(std::make_unique<FlightsReader>(record->reopened(), "", scene_), scene_.world);
        },
        framing.any());
  }

  /// Draws by recorded motions, on a thread of its own if there is one. framed: cameras have been given the motion.
  void draw_by(const MakeMotion& motion, bool framed = false) {
    stages_.begin_drawings();
    const auto draw = [&] {
      const std::vector<MovingCamera*> cameras = framing_cameras();
      if (!framed && !cameras.empty()) survey(cameras, *motion(), watch_.stop_check);
      draw_all(motion);
    };
    DrawingThread drawing(draw);
    if (drawing.is_there())
      drawing.wait([this] { watch_while_drawing(); });
    else
      draw();
    end_drawings();
  }

  /// The cameras of drawings that frame the motion.
  std::vector<MovingCamera*> framing_cameras() {
    std::vector<MovingCamera*> framing;
    for (const Stages::Standing& each : stages_.standing()) {
      if (!each.stage->drawings) continue;
      for (MovingCamera* camera : each.stage->drawings->cameras())
        if (camera->frames_motion()) framing.push_back(camera);
    }
    return framing;
  }

  void draw_all(const MakeMotion& motion) {
    std::vector<Stages::Standing> standing = stages_.standing();
    std::erase_if(standing, [](const Stages::Standing& each) { return !each.stage->drawings; });
    std::vector<MotionSink*> sinks;
    for (const Stages::Standing& each : standing) sinks.push_back(&*each.stage->drawings);

    const std::unique_ptr<Simulator> simulator = motion();
    const SinkGuard guard = [&](std::size_t sink, const std::function<void()>& work) {
      stages_.guarded(standing[sink].show, work);
    };
    carry_through(*simulator, sinks, scene_.simulate.duration, guard, {.stop_check = watch_.stop_check});
  }

  void end_drawings() {
    stages_.each([this](Stage& stage) {
      if (stage.drawings) stage.exports.drawings().end(simulator_->tally());
    });
  }

  void watch_while_drawing() const {
    watch_.stop_check();
    report_progress(RunProgress::Phase::drawing);
  }

  void report_progress(RunProgress::Phase phase) const {
    watch_.report_progress({phase, simulator_->time(), simulator_->tally().collisions(), stages_.pictures()});
  }

  const Scene& scene_;  // one of those that share the motion
  const RunSettings& settings_;
  const RunWatch& watch_;
  EngineChoice engine_;
  Stages stages_;
  std::unique_ptr<Simulator> simulator_;
  StoredEnergy start_;     // at time 0
  double simulate_s_ = 0;  // wall time
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
