// Every run is first recorded and held against the reference, then timed bare: without a record, a look or a file, from
// the making of the simulator to the scene's end. Timed runs of all rows take turns (timing.h).
//
// The reference is the exact engine, or dop853 where paths have no closed form. Its own error is at least what rounding
// does (reference.h), and of dop853 what smaller step errors do. An independent method is held against it: runs by rk4
// in ever shorter steps. Where one of these differs from it more than twice as much as from the run with twice the
// step, they converge to something else: the reference is not trusted to better than the least difference of all.
#include "study/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/force.h"
#include "physics/whole.h"
#include "scene/unsupported.h"
#include "study/engine.h"
#include "study/reference.h"
#include "study/shifted.h"
#include "study/timing.h"

namespace carom {

namespace {

constexpr int halvings = 10;
constexpr int least_repeats = 3;  // that a next row must have room for

constexpr double plainly = 2, far_more = 16;
constexpr std::array quantities = {&Differences::position, &Differences::velocity, &Differences::energy};

/// What runs by rk4 in ever shorter steps say of the exact engine's error.
class Convergence {
 public:
  /// A run's differences from the exact engine's, and from the run with twice the step.
  void take(const Differences& from_exact, const Differences& from_coarser) {
    for (const auto q : quantities) {
      least_.*q = any_ ? std::min(least_.*q, from_exact.*q) : from_exact.*q;
      if (from_exact.*q > plainly * from_coarser.*q) elsewhere_.*q = 1;
    }
    any_ = true;
  }
  /// 0 where it is no more than rounding, or the runs do not tell.
  Differences error(const Differences& rounding) const {
    Differences error;
    for (const auto q : quantities)
      if (elsewhere_.*q > 0 && least_.*q > far_more * rounding.*q) error.*q = least_.*q;
    return error;
  }

 private:
  bool any_ = false;
  Differences least_, elsewhere_;
};

class Bench {
 public:
  Bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch)
      : scene_(scene), world_(scene.world), options_(options), watch_(watch) {}

  BenchResult go() {
    choose_steps();
    reference_ = make_reference(scene_, options_, watch_);
    left_ = std::max(0.2 * options_.budget, options_.budget - spent());
    for (const Engine engine : {Engine::exact, Engine::stepped, Engine::book}) {
      if (const auto lacks = unsupported(world_, with_engine(scene_.simulate, engine)); !lacks.empty())
        result_.left_out.push_back(fmt::format("{}: {}", name_of(engine), lacks.front().what));
      else if (engine == Engine::exact)
        row_of(engine, Integrator::rk4);
      else if (engine == Engine::book)
        rows_of(engine, Integrator::rk4);
      else
        rows_of_stepped();
    }
    tell_of_reference();
    time_rows();
    result_.cpu_s = spent();
    return std::move(result_);
  }

 private:
  SimulationError named(const SimulationError& error) const {
    return error.named([&](Entity body) { return fmt::format("`{}`", scene_.roster.name(body)); });
  }

  double spent() const { return cpu_time() - start_; }

  Simulate way_of(const BenchRow& row) const {
    const auto step = std::isnan(row.step) ? std::nullopt : std::optional(row.step);
    return with_engine(scene_.simulate, row.engine, row.integrator, step);
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

  RecordedRun record(const BenchRow& row, double share) const {
    return record_run(world_, scene_.initial, way_of(row), reference_.instants, look_within(share, watch_.look));
  }

  void fill(BenchRow& row, const RecordedRun& run) {
    row.max_overlap = run.tally.max_overlap;
    row.collisions = run.tally.collisions();
    row.hash = run.hash;
    if (reference_.horizon > 0) row.errors = reference_.off(world_, run);
    if (!reference_.ensemble) return;
    row.statistics = reference_.statistics(world_, run);
    row.speed_distance = reference_.ensemble->speed_distance(row.statistics);
    row.deviation = reference_.ensemble->deviation(row.statistics);
    row.statistics.speeds = {};
  }

  void rows_of_stepped() {
    // Where all paths have closed forms, dop853 follows these too: the row is engine exact's.
    if (force_without_closed_form(world_) != nullptr) row_of(Engine::stepped, Integrator::dop853);
    for (const Integrator integrator : {Integrator::euler, Integrator::verlet, Integrator::rk4})
      rows_of(Engine::stepped, integrator);
  }

  /// Of a method without a step.
  void row_of(Engine engine, Integrator integrator) {
    BenchRow row;
    row.engine = engine;
    row.integrator = integrator;
    try {
      const bool is_reference = reference_.way.engine == engine;
      const RecordedRun other = is_reference ? RecordedRun{} : record(row, left_);
      const RecordedRun& run = is_reference ? reference_.run : other;
      fill(row, run);
      row.repeats =
          static_cast<int>(std::clamp<std::int64_t>(whole_below(0.2 * left_ / run.cpu_s), 1, options_.repeat));
    } catch (const Overrun&) {
      result_.left_out.push_back(
          fmt::format("{}: one run takes more than {:.2g} s of CPU time", method_name(engine, integrator), left_));
      return;
    } catch (const SimulationError& error) {
      row.failure = named(error).what();
    }
    result_.rows.push_back(std::move(row));
  }

  /// From the longest step on, until the next one would cost more than this method's share.
  void rows_of(Engine engine, Integrator integrator) {
    double share = left_ / 4, bare = 0, records = 0;  // s: what a run takes, and what recording it takes beside that
    for (const double step : steps_) {
      if (records + (2 + least_repeats) * 2 * bare > share) {
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
        RecordedRun run = record(row, 0.5 * share);
        fill(row, run);
        row.cpu_s = bare = time_once(row);
        records = std::max(0.0, run.cpu_s - bare);
        share -= run.cpu_s + bare;
        row.repeats = static_cast<int>(std::clamp<std::int64_t>(whole_below(share / bare), 0, options_.repeat));
        share -= row.repeats * bare;
        if (engine == Engine::stepped && integrator == Integrator::rk4) check_reference(std::move(run));
      } catch (const Overrun&) {
        result_.left_out.push_back(fmt::format("{}: steps of {:.4g} s and shorter, one run takes more than {:.2g} s",
                                               method_name(engine, integrator), step, 0.5 * share));
        return;
      } catch (const SimulationError& error) {
        row.failure = named(error).what();
      }
      result_.rows.push_back(std::move(row));
    }
  }

  /// By a run with half the step of the one before.
  void check_reference(RecordedRun run) {
    if (coarser_)
      convergence_.take(reference_.off(world_, run),
                        differences(world_, *coarser_, run, reference_.instants, reference_.horizon));
    coarser_ = std::move(run);
  }

  void tell_of_reference() {
    result_.reference = reference_.way.engine;
    result_.rounding = reference_.rounding;
    result_.chaotic = reference_.chaotic;
    result_.horizon = reference_.horizon;
    result_.reference_error = reference_.error;
    if (reference_.ensemble) {
      result_.members = reference_.ensemble->size();
      result_.mean = reference_.ensemble->mean();
    }
    const Differences more = convergence_.error(reference_.error);
    result_.checked_by_steps = more.position > 0;
    result_.reference_error = larger(result_.reference_error, more);
    for (BenchRow& row : result_.rows)
      if (std::isnan(row.step) && row.engine == result_.reference && row.errors) row.errors = result_.reference_error;
  }

  /// Nothing recorded; the result must be the row's. Gives the CPU time (s).
  double time_once(const BenchRow& row) const {
    const double start = cpu_time();
    if (bare_run(world_, scene_.initial, way_of(row), watch_.look) != row.hash)
      throw std::runtime_error(
          fmt::format("the result is another one at each run of {}", method_name(row.engine, row.integrator)));
    return cpu_time() - start;
  }

  /// A row without repeats has its time already, from the one run that there was time for.
  void time_rows() {
    std::vector<BenchRow*> rows;
    std::vector<TimedTask> tasks;
    for (BenchRow& row : result_.rows) {
      if (!row.failure.empty() || row.repeats == 0) continue;
      rows.push_back(&row);
      tasks.push_back({[this, &row] { time_once(row); }, row.repeats});
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
  double left_ = 0;            // s of CPU time for the rows
  std::vector<double> steps_;  // s, from the longest
  Reference reference_;
  std::optional<RecordedRun> coarser_;  // the last one by rk4
  Convergence convergence_;
  BenchResult result_;
};

}  // namespace

std::string method_name(Engine engine, Integrator integrator) {
  return engine == Engine::stepped ? fmt::format("stepped {}", name_of(integrator)) : name_of(engine);
}

double rounding_of(const Scene& scene) {
  return 0x1p-53 * extent(scene.world, scene.initial);
}

BenchResult run_bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch) {
  return Bench(scene, options, watch).go();
}

}  // namespace carom
