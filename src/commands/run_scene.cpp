#include "commands/run_scene.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "commands/interrupt.h"
#include "physics/energy.h"
#include "render/renderer.h"

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

double energy(const Scene& scene, const State& state) {
  return kinetic_energy(scene.world, state) + potential_energy(scene.world, state);
}

class Run {
 public:
  Run(const Scene& scene, EngineChoice& engine, const std::string& folder, Progress& progress, RunFacts& facts)
      : scene_(scene), progress_(progress), facts_(facts), exports_(scene, folder) {
    const Stopwatch watch(facts_.simulate_s);
    settle_step(scene, engine, stop_if_interrupted);
    simulator_ = make_simulator(scene, scene.output.collisions, engine.step);
    energy_start_ = energy(scene, simulator_->state());
    renderers_.resize(exports_.pictures().size());
  }

  void go() {
    Timeline& timeline = exports_.timeline();
    while (timeline.advance()) {
      carry_to(timeline.time());
      if (!exports_.wants_state()) continue;
      const State& state = simulator_->state();
      {
        const Stopwatch watch(facts_.export_s);
        exports_.sample(state, exports_.wants_contacts() ? simulator_->contacts() : std::span<const ContactForce>{});
      }
      draw_what_is_due(state);
    }
  }

  Simulator& simulator() { return *simulator_; }
  double energy_start() const { return energy_start_; }  // J
  Exports& exports() { return exports_; }

 private:
  // In slices, so that a signal is heard and progress shown where no output is due for long. Looking moves nothing, so
  // the slices change no bit of the motion.
  void carry_to(double time) {
    const double slice = scene_.simulate.duration / 1000;
    stop_if_interrupted();
    while (simulator_->time() < time) {
      const double before = simulator_->time();
      const std::uint64_t collisions_before = simulator_->tally().collisions();
      const double next = std::min(time, before + slice);
      {
        const Stopwatch watch(facts_.simulate_s);
        simulator_->advance_to(next > before ? next : time);
      }
      const std::span<const Collision> collisions = simulator_->collisions();
      if (!collisions.empty()) {
        const Stopwatch watch(facts_.export_s);
        exports_.record(collisions);
      } else if (!(simulator_->time() > before) && simulator_->tally().collisions() == collisions_before) {
        throw SimulationError("the simulator does not go on");
      }
      stop_if_interrupted();
      progress_.update(simulator_->time(), simulator_->tally().collisions(), exports_.frames());
    }
  }

  void draw_what_is_due(const State& state) {
    const std::vector<PictureStream>& streams = exports_.pictures();
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (!exports_.timeline().due(streams[i].timeline_stream)) continue;
      stop_if_interrupted();
      const Image* image = nullptr;
      bool again = false;
      {
        const Stopwatch watch(facts_.render_s);
        // Made at the first picture that is due, and never for a scene that wants none: no OpenGL context, no mesh.
        if (!renderers_[i]) renderers_[i] = std::make_unique<Renderer>(scene_, streams[i].size, streams[i].samples);
        const std::uint64_t before = renderers_[i]->drawn();
        image = &renderers_[i]->draw(state);
        again = renderers_[i]->drawn() == before;
      }
      {
        const Stopwatch watch(facts_.export_s);
        exports_.picture(i, *image, again);
      }
      progress_.update(simulator_->time(), simulator_->tally().collisions(), exports_.frames());
    }
  }

  const Scene& scene_;
  Progress& progress_;
  RunFacts& facts_;
  Exports exports_;
  std::unique_ptr<Simulator> simulator_;
  double energy_start_ = 0;
  std::vector<std::unique_ptr<Renderer>> renderers_;  // by picture stream
};

// Momentum just after the impulses given at time 0.
Vec3 starting_momentum(const Scene& scene) {
  Vec3 sum = momentum(scene.world, scene.initial);
  for (const Vec3& impulse : scene.world.impulse) sum += impulse;
  return sum;
}

// The energy at the start is that of energy.csv's first row: the exact engine's bodies have their impulses by then, the
// book engine's get theirs as a force of the first frame, whose work counts. What energy the collisions, work and
// motion do not account for is the residual: zero but for rounding.
Summary summarize(const Scene& scene, const EngineChoice& engine, double energy_start, const State& end,
                  const Tally& tally) {
  Summary summary;
  summary.title = scene.title;
  summary.engine = engine.name;
  summary.status = "done";
  summary.duration = scene.simulate.duration;
  summary.bodies = scene.world.body_count();
  summary.collisions = tally.collisions();
  summary.body_body = tally.body_body;
  summary.body_fixed = tally.body_fixed;
  summary.first_collision = tally.first_collision;
  summary.last_collision = tally.last_collision;
  summary.energy_start = energy_start;
  summary.energy_end = energy(scene, end);
  summary.energy_lost = tally.energy_lost;
  summary.work = tally.work;
  summary.energy_residual = summary.energy_end - summary.energy_start - summary.work + summary.energy_lost;
  summary.momentum_drift = (momentum(scene.world, end) - starting_momentum(scene)).norm();
  summary.max_overlap = tally.max_overlap;
  summary.max_speed = tally.max_speed;
  summary.resting = tally.resting;
  summary.merges = tally.merges;
  summary.collapses = tally.collapses;
  return summary;
}

}  // namespace

RunResult run_scene(const Scene& scene, const EngineChoice& engine, const std::string& folder, double load_s,
                    Progress& progress) {
  RunResult result;
  result.engine = engine;
  result.facts.load_s = load_s;
  {
    const Stopwatch wall(result.wall_s);
    Run run(scene, result.engine, folder, progress, result.facts);
    run.go();
    result.summary = summarize(scene, engine, run.energy_start(), run.simulator().state(), run.simulator().tally());
    result.summary.frames = run.exports().frames();
    result.facts.peak_memory = peak_memory();
    run.exports().finish(result.summary, result.facts);
    progress.clear();
  }
  return result;
}

}  // namespace carom
