// Every run is first recorded and held against the reference, then timed bare: without a record, a look or a file, from
// the making of the simulator to the scene's end. Timed runs of all rows take turns (timing.h).
//
// Rounding. The scene is run again in shifted coordinates (shifted.h), where every place has other last digits. What
// differs then is what rounding does. Where it moves a body by more than a hundredth of the largest radius, others meet
// in the end than would have met, and the scene is chaotic: its trajectories are compared only until rounding has grown
// 2^14-fold; beyond, its statistics are, and more shifted runs say how much these may differ.
//
// The reference's own error. What rounding does is the least it can be off. The exact engine is also held against that
// run of the stepped one, by rk4, that comes closest to it: where that still differs from it more than twice as much as
// from the run with twice the step, and as rounding explains, the difference is taken to be the exact engine's. A
// stepped reference is off by at most about what it differs from its run with twice the step.
#include "study/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/unsupported.h"
#include "simulate/stepped.h"
#include "study/engine.h"
#include "study/shifted.h"
#include "study/timing.h"

namespace carom {

namespace {

constexpr int most_instants = 64;
constexpr double golden = 0.6180339887498949;  // where in its part an instant lies: no round number is there
constexpr double states_kept = 1e6;            // of all bodies, in one run
constexpr int halvings = 10;
constexpr int shifted_runs = 3;
constexpr int ensemble_runs = 12;
constexpr double resolved = 2e-3;  // s: a run that takes this long tells what a longer one takes
constexpr double astray = 0.01;    // of the largest radius
constexpr double last_digit = 0x1p-53, grown = 0x1p14;

/// One run takes more than what is left.
struct Overrun {};

std::vector<double> instants_in(double from, double to, std::size_t bodies) {
  const auto most = static_cast<int>(states_kept / static_cast<double>(std::max<std::size_t>(bodies, 1)));
  const int count = std::clamp(most, 8, most_instants);
  std::vector<double> instants;
  for (int k = 0; k < count; ++k) instants.push_back(from + (to - from) * (k + golden) / count);
  return instants;
}

Differences larger(const Differences& a, const Differences& b) {
  return {std::max(a.position, b.position), std::max(a.velocity, b.velocity), std::max(a.energy, b.energy),
          std::max(a.missed, b.missed), std::max(a.invented, b.invented)};
}

Differences twice(const Differences& d) {
  return {2 * d.position, 2 * d.velocity, 2 * d.energy, d.missed, d.invented};
}

/// What `far` says beyond what `near` explains.
Differences beyond(const Differences& far, const Differences& near) {
  const auto more = [](double f, double n) { return f > 2 * n ? f : 0.0; };
  return {more(far.position, near.position), more(far.velocity, near.velocity), more(far.energy, near.energy), 0, 0};
}

/// A run by rk4, held against the reference and against the run with twice the step.
struct Check {
  Differences from_reference, from_coarser;
};

class Bench {
 public:
  Bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch)
      : scene_(scene), world_(scene.world), options_(options), watch_(watch), left_(options.budget) {}

  BenchResult go() {
    const double start = cpu_time();
    choose_steps();
    make_reference();
    for (const Engine engine : {Engine::exact, Engine::stepped, Engine::book}) {
      if (const auto lacks = unsupported(world_, simulate(engine)); !lacks.empty())
        result_.left_out.push_back(fmt::format("{}: {}", name_of(engine), lacks.front().what));
      else if (engine == Engine::exact)
        exact_row();
      else if (engine == Engine::book)
        rows_of(engine, Integrator::rk4);
      else
        for (const Integrator integrator : {Integrator::euler, Integrator::verlet, Integrator::rk4})
          rows_of(engine, integrator);
    }
    estimate_reference_error();
    time_rows();
    result_.cpu_s = cpu_time() - start;
    return std::move(result_);
  }

 private:
  Simulate simulate(Engine engine, Integrator integrator = Integrator::rk4, std::optional<double> step = {}) const {
    Simulate simulate = scene_.simulate;
    simulate.engine = engine;
    simulate.integrator = integrator;
    simulate.step = step;
    simulate.tolerance.reset();
    return simulate;
  }

  /// Powers of two (s), from 1/4 of the duration or 64 default steps down, unless they are given.
  void choose_steps() {
    const double duration = scene_.simulate.duration;
    if (world_.body_count() == 0) throw SimulationError("the scene has no bodies: there is nothing to measure");
    if (!(duration > 0)) throw SimulationError("the scene lasts 0 s: there is nothing to measure");
    const double most = std::min(0.25 * duration, 64 * default_step(world_, scene_.initial));
    const double longest = options_.longest.value_or(std::exp2(std::floor(std::log2(most))));
    const double shortest = options_.shortest.value_or(std::ldexp(longest, -halvings));
    for (double step = longest; step >= shortest * (1 - 1e-9); step *= 0.5) steps_.push_back(step);
  }

  /// A recorded run that may take `share` (s) of CPU time.
  RecordedRun record(const World& world, const State& initial, const Simulate& simulate, double share) {
    const double start = cpu_time();
    return record_run(world, initial, simulate, instants_, [&] {
      watch_.look();
      if (cpu_time() - start > share) throw Overrun{};
    });
  }

  void make_reference() {
    const bool exact_runs = unsupported(world_, simulate(Engine::exact)).empty();
    result_.reference = options_.reference.value_or(exact_runs ? Engine::exact : Engine::stepped);
    Simulate way = simulate(result_.reference);
    if (const auto lacks = unsupported(world_, way); !lacks.empty())
      throw SimulationError("there is no reference: " + lacks.front().what);
    if (result_.reference == Engine::stepped) way.step = result_.reference_step = choose_reference_step();
    watch_.tell(0, "the reference");
    const double duration = scene_.simulate.duration;
    instants_ = instants_in(0, duration, world_.body_count());
    try {
      reference_ = record(world_, scene_.initial, way, 0.5 * options_.budget);
      std::vector<RecordedRun> others;
      const double share = 0.5 * options_.budget;
      for (int k = 1; k <= shifted_runs && (k == 1 || (k + 1) * reference_.cpu_s < 0.2 * options_.budget); ++k)
        others.push_back(shifted_run(way, k, share));
      judge(others);
      result_.reference_error = {};
      if (result_.chaotic) {
        instants_ = instants_in(0, result_.horizon, world_.body_count());
        if (!(result_.horizon > 0)) instants_.clear();
        trajectory_instants_ = instants_.size();
        for (const double later : instants_in(result_.horizon, duration, world_.body_count()))
          instants_.push_back(later);
        reference_ = record(world_, scene_.initial, way, share);
        gather_ensemble(way);
      } else {
        for (const RecordedRun& other : others) result_.reference_error = larger(result_.reference_error, off(other));
      }
      if (result_.reference == Engine::stepped) {
        const RecordedRun coarser = record(
            world_, scene_.initial, simulate(Engine::stepped, Integrator::rk4, 2 * result_.reference_step), left_);
        result_.reference_error = larger(result_.reference_error, off(coarser));
      }
    } catch (const Overrun&) {
      throw SimulationError(
          fmt::format("the reference, by {}, takes too long for a budget of {} s: give it more (--budget), or "
                      "shorten simulate.duration",
                      method_name(result_.reference, Integrator::rk4), options_.budget));
    }
    left_ = std::max(0.2 * options_.budget, options_.budget - spent());
  }

  double spent() const { return cpu_time() - start_; }

  /// s: a quarter of the shortest step, or longer, so that the reference takes no more than a third of the budget.
  double choose_reference_step() {
    double step = steps_.front(), cost = 0;
    for (const double longer : steps_) {
      const double start = cpu_time();
      bare_run(world_, scene_.initial, simulate(Engine::stepped, Integrator::rk4, longer), watch_.look);
      step = longer;
      cost = cpu_time() - start;
      if (cost > resolved) break;
    }
    const double share = options_.budget / 3 / (2 + shifted_runs);
    while (step > 0.25 * steps_.back() && 2 * cost < share) step *= 0.5, cost *= 2;
    while (steps_.size() > 1 && steps_.back() < 3.9 * step) steps_.pop_back();
    return step;
  }

  RecordedRun shifted_run(const Simulate& way, int number, double share) {
    const Vec3 by = shift(extent(world_, scene_.initial), number);
    const World world = shifted(world_, by);
    RecordedRun run = record(world, shifted(scene_.initial, by), way, share);
    for (State& state : run.states) state = shifted(std::move(state), -by);
    return run;
  }

  /// Whether rounding grows until trajectories mean nothing, and until when they do.
  void judge(const std::vector<RecordedRun>& others) {
    const double size = extent(world_, scene_.initial);
    result_.horizon = scene_.simulate.duration;
    double until = 0;
    for (std::size_t k = 0; k < instants_.size(); ++k) {
      for (const RecordedRun& other : others)
        for (Entity i = 0; i < world_.body_count(); ++i)
          result_.rounding =
              std::max(result_.rounding, (other.states[k].position[i] - reference_.states[k].position[i]).norm());
      if (result_.rounding <= grown * last_digit * size) until = instants_[k];
    }
    result_.chaotic = result_.rounding > astray * *std::max_element(world_.radius.begin(), world_.radius.end());
    if (result_.chaotic) result_.horizon = until;
  }

  void gather_ensemble(const Simulate& way) {
    std::vector<Statistics> members = {statistics(reference_)};
    for (int k = 1; k <= ensemble_runs && (k <= 3 || spent() + reference_.cpu_s < 0.5 * options_.budget); ++k) {
      watch_.tell(0, "the reference, shifted");
      const RecordedRun run = shifted_run(way, k, options_.budget);
      members.push_back(statistics(run));
      result_.reference_error = larger(result_.reference_error, off(run));
    }
    ensemble_.emplace(std::move(members));
    result_.members = ensemble_->size();
    result_.mean = ensemble_->mean();
  }

  Statistics statistics(const RecordedRun& run) const {
    return statistics_of(world_, run, scene_.simulate.duration, trajectory_instants_);
  }

  Differences off(const RecordedRun& run) const {
    return differences(world_, reference_, run, instants_, result_.horizon);
  }

  void fill(BenchRow& row, const RecordedRun& run) {
    row.max_overlap = run.tally.max_overlap;
    row.collisions = run.tally.collisions();
    row.hash = run.hash;
    row.repeats = options_.repeat;
    if (result_.horizon > 0) row.errors = off(run);
    if (!ensemble_) return;
    row.statistics = statistics(run);
    row.speed_distance = ensemble_->speed_distance(row.statistics);
    row.deviation = ensemble_->deviation(row.statistics);
    row.statistics.speeds = {};
  }

  void exact_row() {
    BenchRow row;
    try {
      const RecordedRun run = result_.reference == Engine::exact
                                  ? reference_
                                  : record(world_, scene_.initial, simulate(Engine::exact), left_);
      fill(row, run);
      row.repeats = std::clamp(static_cast<int>(0.2 * left_ / run.cpu_s), 1, options_.repeat);
    } catch (const Overrun&) {
      result_.left_out.push_back(fmt::format("exact: one run takes more than {:.2g} s of CPU time", left_));
      return;
    } catch (const SimulationError& error) {
      row.failure = error.what();
    }
    result_.rows.push_back(std::move(row));
  }

  /// From the longest step on, until the next one would cost more than this method's share.
  void rows_of(Engine engine, Integrator integrator) {
    double share = left_ / 4, bare = 0, records = 0;  // s: what a run takes, and what recording it takes beside that
    for (const double step : steps_) {
      if (records + 5 * 2 * bare > share) {
        result_.left_out.push_back(fmt::format("{}: steps below {:.4g} s, for the budget of {:.4g} s of CPU time",
                                               method_name(engine, integrator), 2 * step, options_.budget));
        return;
      }
      const double rows = static_cast<double>(result_.rows.size()) / static_cast<double>(4 * steps_.size() + 1);
      watch_.tell(0.5 * std::max(rows, std::min(1.0, spent() / options_.budget)),
                  fmt::format("{}, steps of {:.3g} s", method_name(engine, integrator), step));
      BenchRow row;
      row.engine = engine;
      row.integrator = integrator;
      row.step = step;
      try {
        const Simulate way = simulate(engine, integrator, step);
        RecordedRun run = record(world_, scene_.initial, way, 0.5 * share);
        fill(row, run);
        row.cpu_s = bare = time_once(row, way);
        records = std::max(0.0, run.cpu_s - bare);
        share -= run.cpu_s + bare;
        row.repeats = std::clamp(static_cast<int>(share / bare), 0, options_.repeat);
        share -= row.repeats * bare;
        if (engine == Engine::stepped && integrator == Integrator::rk4) check_reference(std::move(run));
      } catch (const Overrun&) {
        result_.left_out.push_back(fmt::format("{}: steps of {:.4g} s and shorter, one run takes more than {:.2g} s",
                                               method_name(engine, integrator), step, 0.5 * share));
        return;
      } catch (const SimulationError& error) {
        row.failure = error.what();
      }
      result_.rows.push_back(std::move(row));
    }
  }

  /// By a run with half the step of the one before.
  void check_reference(RecordedRun run) {
    if (result_.reference != Engine::exact) return;
    if (coarser_) {
      const Check check{off(run), differences(world_, *coarser_, run, instants_, result_.horizon)};
      if (!closest_ || check.from_reference.position < closest_->from_reference.position) closest_ = check;
    }
    coarser_ = std::move(run);
  }

  void estimate_reference_error() {
    if (result_.reference != Engine::exact) return;
    if (closest_) {
      const Differences explained = larger(closest_->from_coarser, twice(result_.reference_error));
      const Differences more = beyond(closest_->from_reference, explained);
      result_.checked_by_steps = more.position > 0;
      result_.reference_error = larger(result_.reference_error, more);
    }
    for (BenchRow& row : result_.rows)
      if (row.engine == Engine::exact && row.errors) row.errors = result_.reference_error;
  }

  /// Nothing recorded; the result must be the row's.
  void run_again(const BenchRow& row, const Simulate& way) const {
    if (bare_run(world_, scene_.initial, way, watch_.look) == row.hash) return;
    throw SimulationError(
        fmt::format("the result is another one at each run of {}", method_name(row.engine, row.integrator)));
  }

  /// s of CPU time.
  double time_once(const BenchRow& row, const Simulate& way) const {
    const double start = cpu_time();
    run_again(row, way);
    return cpu_time() - start;
  }

  /// A row without repeats has its time already, from the one run that there was time for.
  void time_rows() {
    std::vector<BenchRow*> rows;
    std::vector<TimedTask> tasks;
    for (BenchRow& row : result_.rows) {
      if (!row.failure.empty() || row.repeats == 0) continue;
      rows.push_back(&row);
      const auto step = std::isnan(row.step) ? std::nullopt : std::optional(row.step);
      tasks.push_back(
          {[this, &row, way = simulate(row.engine, row.integrator, step)] { run_again(row, way); }, row.repeats});
    }
    const auto tell = [&](double done) { watch_.tell(0.5 + 0.5 * done, "timed runs"); };
    const std::vector<double> medians = time_in_turns(tasks, tell);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k]->cpu_s = medians[k];
    for (BenchRow& row : result_.rows) row.repeats = std::max(row.repeats, 1);
  }

  const Scene& scene_;
  const World& world_;
  const BenchOptions& options_;
  const BenchWatch& watch_;
  const double start_ = cpu_time();
  double left_;                          // s of CPU time for the rows
  std::vector<double> steps_;            // s, from the longest
  std::vector<double> instants_;         // s; of a chaotic scene those before the horizon, then those behind it
  std::size_t trajectory_instants_ = 0;  // of a chaotic scene: how many lie before the horizon
  RecordedRun reference_;
  std::optional<Ensemble> ensemble_;    // of a chaotic scene
  std::optional<RecordedRun> coarser_;  // the last one by rk4
  std::optional<Check> closest_;        // of those by rk4
  BenchResult result_;
};

}  // namespace

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::exact:
      return "exact";
    case Engine::stepped:
      return "stepped";
    case Engine::book:
      return "book";
    case Engine::automatic:
      break;
  }
  return "auto";
}

std::string method_name(Engine engine, Integrator integrator) {
  return engine == Engine::stepped ? fmt::format("stepped {}", name_of(integrator)) : name_of(engine);
}

double rounding_of(const Scene& scene) {
  return last_digit * extent(scene.world, scene.initial);
}

BenchResult run_bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch) {
  return Bench(scene, options, watch).go();
}

}  // namespace carom
