#include "study/run_scene.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "physics/compensated.h"
#include "physics/energy.h"
#include "physics/force.h"
#include "render/glb.h"
#include "render/renderer.h"
#include "render/still_things.h"
#include "study/warnings.h"

namespace carom {

namespace {

/// Adds the time from its making to its end to `sum` (s).
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

struct Energy {
  double kinetic = 0, potential = 0;  // J
  double total() const { return kinetic + potential; }
};

Energy energy(const Scene& scene, const State& state) {
  return {kinetic_energy(scene.world, state), potential_energy(scene.world, state)};
}

/// One show on its way.
class Stage {
 public:
  Stage(const Show& show, const RunSettings& settings)
      : scene(*show.scene),
        exports(scene, show.folder, settings.durability, {still_things, glb}, show.renewed),
        renderers_(exports.pictures().size()) {
    facts.load_s = show.load_s;
    more = exports.timeline().advance();
  }

  double time() { return exports.timeline().time(); }  // s, of its next instant

  /// Writes and draws what is due now. `look`, `tell`: of the watch.
  template <typename Look, typename Tell>
  void sample(Simulator& simulator, const Look& look, const Tell& tell) {
    if (exports.wants_state()) {
      const State& state = simulator.state();
      {
        const Stopwatch watch(facts.export_s);
        exports.sample(state, exports.wants_contacts() ? simulator.contacts() : std::span<const ContactForce>{});
      }
      draw_what_is_due(state, look, tell);
    }
    more = exports.timeline().advance();
  }

  const Scene& scene;
  RunFacts facts;
  Exports exports;
  bool more = false;  // whether there is a next instant

 private:
  template <typename Look, typename Tell>
  void draw_what_is_due(const State& state, const Look& look, const Tell& tell) {
    const std::vector<PictureStream>& streams = exports.pictures();
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (!exports.timeline().due(streams[i].timeline_stream)) continue;
      look();
      const Image* image = nullptr;
      bool again = false;
      {
        const Stopwatch watch(facts.render_s);
        // Made at the first picture that is due, and never for a scene that wants none: no OpenGL context, no mesh.
        if (!renderers_[i]) renderers_[i] = std::make_unique<Renderer>(scene, streams[i].size, streams[i].samples);
        const std::uint64_t before = renderers_[i]->drawn();
        image = &renderers_[i]->draw(state);
        again = renderers_[i]->drawn() == before;
      }
      {
        const Stopwatch watch(facts.export_s);
        exports.picture(i, *image, again);
      }
      tell();
    }
  }

  std::vector<std::unique_ptr<Renderer>> renderers_;  // by picture stream
};

// Momentum just after the impulses given at time 0.
Vec3 starting_momentum(const Scene& scene) {
  Vec3 sum = momentum(scene.world, scene.initial);
  for (const Vec3& impulse : scene.world.impulse) sum += impulse;
  return sum;
}

/// A force that acts for ever gives what its potential loses; the rest is in the tally. That is not known of a run
/// told by its record.
std::vector<ForceWork> work_of_forces(const Scene& scene, const State& end, const Tally& tally) {
  const World& world = scene.world;
  std::vector<ForceWork> all;
  if (world.forces.empty() || tally.force_work.empty()) return all;
  Sum fallen;
  for (Entity i = 0; i < world.body_count(); ++i)
    fallen.add(world.mass[i] * world.gravity.dot(end.position[i] - scene.initial.position[i]));
  if (!world.gravity.isZero(0)) all.push_back({"gravity", fallen.value()});
  for (std::size_t k = 0; k < world.forces.size(); ++k) {
    Sum work;
    work.add(tally.force_work[k]);
    for (Entity i = 0; i < world.body_count(); ++i) {
      work.add(potential(world, world.forces[k], i, scene.initial.position[i]));
      work.add(-potential(world, world.forces[k], i, end.position[i]));
    }
    all.push_back({fmt::format("forces.{}.{}", k, name_of(world.forces[k].law)), work.value()});
  }
  // What lifts joint bodies out of what they reach into is no force's.
  if (tally.merges > 0)
    all.push_back(
        {"merging", std::accumulate(tally.force_work.begin(), tally.force_work.end(), tally.work, std::minus())});
  return all;
}

// The energy at the start is that of energy.csv's first row: the exact engine's bodies have their impulses by then, the
// book engine's get theirs as a force of the first frame, whose work counts. What energy the impacts, work and
// motion do not account for is the residual: the method's own error, and rounding.
Summary summarize(const Scene& scene, const EngineChoice& engine, const Energy& start, const State& end,
                  const Tally& tally) {
  Summary summary;
  summary.title = scene.title;
  summary.engine = engine.name;
  summary.duration = scene.simulate.duration;
  summary.bodies = scene.world.body_count();
  summary.collisions = tally.collisions();
  summary.body_body = tally.body_body;
  summary.body_fixed = tally.body_fixed;
  summary.first_collision = tally.first_collision;
  summary.last_collision = tally.last_collision;
  const Energy last = energy(scene, end);
  summary.energy.start = start.total();
  summary.energy.end = last.total();
  summary.energy.lost = tally.energy_lost;
  summary.energy.work = tally.work;
  summary.energy.residual = summary.energy.end - summary.energy.start - summary.energy.work + summary.energy.lost;
  summary.energy.turnover = start.kinetic + last.kinetic + std::abs(last.potential - start.potential) +
                            std::abs(tally.energy_lost) + std::abs(tally.work);
  summary.momentum_drift = (momentum(scene.world, end) - starting_momentum(scene)).norm();
  summary.max_overlap = tally.max_overlap;
  summary.max_speed = tally.max_speed;
  summary.resting = tally.resting;
  summary.stepped_contact = tally.stepped_contact;
  summary.contact = {tally.merges, tally.collapses, tally.taken_up};
  summary.energy.of_forces = work_of_forces(scene, end, tally);
  return summary;
}

class Run {
 public:
  Run(std::span<const Show> shows, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch)
      : shows_(shows), settings_(settings), watch_(watch), engine_(engine), results_(shows.size()) {
    for (std::size_t i = 0; i < shows.size(); ++i) {
      stages_.emplace_back();
      guarded(i, [&] {
        check_flights(*shows[i].scene);
        stages_[i] = std::make_unique<Stage>(shows[i], settings);
      });
    }
    const Stopwatch stopwatch(simulate_s_);
    if (!settings.simulator) settle_steps(scene(), engine_, watch_.look);
    const bool collisions =
        std::any_of(shows.begin(), shows.end(), [](const Show& show) { return show.scene->output.collisions; });
    const bool paths =
        std::any_of(shows.begin(), shows.end(), [](const Show& show) { return show.scene->output.flights; });
    simulator_ =
        settings.simulator ? settings.simulator(scene()) : make_simulator(scene(), collisions, engine_.steps, paths);
    record({}, simulator_->paths());
    start_ = energy(scene(), simulator_->state());
  }

  void go() {
    while (const std::optional<double> time = next_instant()) {
      carry_to(*time);
      for (std::size_t i = 0; i < stages_.size(); ++i) {
        if (stages_[i] && stages_[i]->more && stages_[i]->time() <= *time)
          guarded(i, [&] { stages_[i]->sample(*simulator_, watch_.look, [&] { tell(); }); });
      }
    }
  }

  std::vector<RunResult> finish() {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      if (stages_[i]) guarded(i, [&] { finish(i); });
    return std::move(results_);
  }

 private:
  const Scene& scene() const { return *shows_.front().scene; }  // whose motion it is

  /// What fails for one of several shows is no other's failure.
  template <typename Work>
  void guarded(std::size_t i, const Work& work) {
    try {
      work();
    } catch (const std::exception&) {
      watch_.look();  // ffmpeg hears a Ctrl-C too and ends first: what looks like an error of writing is the interrupt
      if (shows_.size() == 1) throw;
      results_[i].failure = std::current_exception();
      stages_[i].reset();
    }
  }

  std::optional<double> next_instant() const {
    std::optional<double> next;
    for (const auto& stage : stages_)
      if (stage && stage->more && !(next && *next <= stage->time())) next = stage->time();
    return next;
  }

  // In slices, so that a signal is heard and progress shown where no output is due for long. Looking moves nothing, so
  // the slices change no bit of the motion.
  void carry_to(double time) {
    const double slice = scene().simulate.duration / 1000;
    watch_.look();
    while (simulator_->time() < time) {
      const double before = simulator_->time();
      const std::uint64_t collisions_before = simulator_->tally().collisions();
      const double next = std::min(time, before + slice);
      {
        const Stopwatch watch(simulate_s_);
        simulator_->advance_to(next > before ? next : time);
      }
      const std::span<const Collision> collisions = simulator_->collisions();
      const std::span<const PathPiece> paths = simulator_->paths();
      record(collisions, paths);
      if (collisions.empty() && paths.empty() && !(simulator_->time() > before) &&
          simulator_->tally().collisions() == collisions_before)
        throw SimulationError("the simulator does not go on");
      watch_.look();
      tell();
    }
  }

  void record(std::span<const Collision> collisions, std::span<const PathPiece> paths) {
    if (collisions.empty() && paths.empty()) return;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      if (!stages_[i]) continue;
      guarded(i, [&] {
        const Stopwatch watch(stages_[i]->facts.export_s);
        stages_[i]->exports.record(collisions);
        stages_[i]->exports.record_paths(paths);
      });
    }
  }

  void tell() const {
    std::uint64_t pictures = 0;
    for (const auto& stage : stages_)
      if (stage) pictures += stage->exports.frames();
    watch_.tell(simulator_->time(), simulator_->tally().collisions(), pictures);
  }

  void finish(std::size_t i) {
    Stage& stage = *stages_[i];
    RunResult& result = results_[i];
    const State& end = simulator_->state();
    result.engine = engine_;
    result.summary = summarize(stage.scene, engine_, start_, end, simulator_->tally());
    result.summary.warnings = settings_.warnings
                                  ? *settings_.warnings
                                  : warnings_of(stage.scene, engine_, end, result.summary, simulator_->tally());
    result.summary.status = result.summary.warnings.empty() ? "done" : "doubtful";
    result.summary.frames = stage.exports.frames();
    result.facts = stage.facts;
    result.facts.simulate_s = simulate_s_;
    result.facts.peak_memory = peak_memory();
    result.facts.left_out = stage.exports.end(simulator_->tally());
    if (settings_.measure) result.facts.measures = settings_.measure(stage.scene, end, result.summary);
    stage.exports.finish(result.summary, result.facts);
  }

  std::span<const Show> shows_;
  const RunSettings& settings_;
  const RunWatch& watch_;
  EngineChoice engine_;
  std::vector<RunResult> results_;              // by show
  std::vector<std::unique_ptr<Stage>> stages_;  // by show; none: it has failed
  std::unique_ptr<Simulator> simulator_;
  Energy start_;           // at time 0
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
