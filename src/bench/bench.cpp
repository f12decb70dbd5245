// Every run is first recorded and compared with the reference, and then timed without records, samples and files.
// The timed part is from making the simulator to the scene's end. Timed runs of all rows take turns (timing.h).
//
// The first reference is the exact engine, or dop853 where paths have no closed form.
// The finest runs of all other methods are compared with it (evidence.h).
// If they confirm another one, that becomes the reference, and all rows are compared again.
#include "bench/bench.h"

#include <fmt/format.h>

#include "bench/reference.h"
#include "bench/shifted.h"
#include "bench/timing.h"
#include "engine/engine.h"
#include "numerics/whole.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace {

constexpr int halvings = 10;
// The minimum of repeats for which a next row must have time left.
constexpr int least_repeats = 3;

/// The errors of dop853's steps, as a share of a radius and of speeds. The last one is the default.
constexpr array step_errors = {0x1p-16, 0x1p-24, 0x1p-32, exact_tolerance::step_error};

class Bench {
 public:
  Bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch)
      : scene_(scene),
        world_(scene.world),
        options_(options),
        all_(watch),
        watch_{watch.stop_check,
               [this](double done, const string& what) { all_.report_progress(share_ * done, what); }} {}

  BenchResult go() {
    choose_steps();
    try {
      reference_ = make_reference(scene_, options_, watch_);
    } catch (const SimulationError& error) {
      throw named(error);
    }

    evidence_.emplace(world_, reference_.instants, reference_.horizon, reference_.rounded,
                      rounding_of(world_, scene_.initial),
                      Finding{reference_.method, reference_.run, reference_.error});
    if (reference_.second) evidence_->add(*std::move(reference_.second));

    // Half of the time is for the qualities of crowds.
    const bool has_crowds = reference_.run.tally.stepped_contact > 0 && reference_.method.engine == Engine::exact;
    share_ = has_crowds ? 0.5 : 1;
    left_ = max(0.2 * options_.budget, share_ * options_.budget - spent());

    // Each engine has its rows, or a reason why it has none.
    for (const Engine engine : {Engine::exact, Engine::stepped, Engine::book}) {
      if (const auto lacks = unsupported(world_, with_engine(scene_.simulate, engine)); !lacks.empty())
        result_.left_out.push_back(fmt::format("{}: {}", name_of(engine), lacks.front().what));
      else if (engine == Engine::exact)
        row_of({});
      else if (engine == Engine::book)
        rows_of({.engine = engine});
      else
        rows_of_stepped();
    }

    settle_reference();
    time_rows();
    if (has_crowds) measure_crowds();
    result_.cpu_s = spent();
    return std::move(result_);
  }

 private:
  SimulationError named(const SimulationError& error) const {
    return error.named([&](Entity body) { return fmt::format("`{}`", scene_.roster.name(body)); });
  }

  double spent() const { return cpu_time() - start_; }

  /// Steps are powers of two (s), from 1/4 of the duration or 64 default steps down, unless they are given.
  void choose_steps() {
    const double duration = scene_.simulate.duration;
    if (world_.body_count() == 0) throw SimulationError("the scene has no bodies: there is nothing to measure");
    if (!(duration > 0)) throw SimulationError("the scene lasts 0 s: there is nothing to measure");

    const double most = min(0.25 * duration, 64 * default_step(world_, scene_.initial));
    const double longest = options_.longest.value_or(std::exp2(floor(std::log2(most))));
    const double shortest = options_.shortest.value_or(std::ldexp(longest, -halvings));
    for (double step = longest; step >= shortest * (1 - 1e-9); step *= 0.5) steps_.push_back(step);
  }

  RecordedRun record(const SimulationMethod& method, const function<void()>& stop_check) const {
    return record_run(world_, scene_.initial, settings_of(scene_.simulate, method), method.steps, reference_.instants,
                      stop_check);
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
    // Along parabolas dop853 has no steps, so its row would be that of the exact engine.
    if (varying_force(world_) != nullptr)
      for (const double error : step_errors) row_of(dop853(world_, error));
    for (const Integrator integrator : {Integrator::euler, Integrator::verlet, Integrator::rk4})
      rows_of({.engine = Engine::stepped, .integrator = integrator});
  }

  /// Adds the row of a method that chooses its own steps.
  void row_of(const SimulationMethod& method) {
    BenchRow row;
    row.method = method;
    try {
      const bool recorded = method == reference_.method;
      const RecordedRun other = recorded ? RecordedRun{} : record(method, stop_check_within(left_, watch_.stop_check));
      const RecordedRun& run = recorded ? reference_.run : other;

      // One run more is evidence. It is timed as often as the budget allows.
      fill(row, run);
      if (method.engine == Engine::exact && !recorded && reference_.horizon > 0)
        evidence_->add({method, run, reference_.rounded});
      row.repeats = int(clamp<int64_t>(whole_below(0.2 * left_ / run.cpu_s), 1, options_.repeat));

    } catch (const Overrun&) {
      result_.left_out.push_back(
          fmt::format("{}: one run takes more than {:.2g} s of CPU time", full_name_of(method), left_));
      return;
    } catch (const SimulationError& error) {
      row.failure = named(error).what();
    }
    result_.rows.push_back(std::move(row));
  }

  /// Adds rows from the longest step on, until the next one would exceed this method's share of the time.
  void rows_of(SimulationMethod method) {
    // In s: the time of a run, and the additional time of recording it.
    double share = left_ / 4, bare = 0, records = 0;
    for (const double step : steps_) {
      if (records + (2 + least_repeats) * 2 * bare > share) {
        result_.left_out.push_back(
            fmt::format("{}: steps below {:.4g} s, which exceed the budget of {:.4g} s of CPU time", name_of(method),
                        2 * step, options_.budget));
        return;
      }

      method.steps.length = step;
      const double rows = double(result_.rows.size()) / double(4 * steps_.size() + 5);
      watch_.report_progress(0.5 * max(rows, min(1.0, spent() / options_.budget)), full_name_of(method));

      BenchRow row;
      row.method = method;
      try {
        RecordedRun run = record(method, stop_check_within(0.5 * share, watch_.stop_check));
        fill(row, run);

        // The rest of the share bounds the repeats and the next row.
        row.cpu_s = bare = time_once(row);
        records = max(0.0, run.cpu_s - bare);
        share -= run.cpu_s + bare;
        row.repeats = int(clamp<int64_t>(whole_below(share / bare), 0, options_.repeat));
        share -= row.repeats * bare;
        // The error of the book's engine comes from overlaps of bodies, however smooth their paths are.
        if (reference_.horizon > 0 && method.engine == Engine::stepped) evidence_->add_halved(method, std::move(run));

      } catch (const Overrun&) {
        result_.left_out.push_back(fmt::format("{}: steps of {:.4g} s and shorter, one run takes more than {:.2g} s",
                                               name_of(method), step, 0.5 * share));
        return;
      } catch (const SimulationError& error) {
        row.failure = named(error).what();
      }
      result_.rows.push_back(std::move(row));
    }
  }

  void settle_reference() {
    result_.rounding = reference_.rounding;
    result_.inexact_islands = reference_.run.inexact_islands;
    result_.chaotic = reference_.chaotic;

    result_.horizon = reference_.horizon;
    if (reference_.ensemble) {
      result_.members = reference_.ensemble->size();
      result_.mean = reference_.ensemble->mean();
    }

    // Other methods may have shown that the first reference is not the best.
    if (reference_.horizon > 0) {
      Verdict verdict = evidence_->verdict(options_.reference.has_value());
      reference_.error = verdict.error;
      result_.witnesses = std::move(verdict.witnesses);
      if (verdict.reference > 0) take_reference(evidence_->findings()[verdict.reference]);
    }

    result_.reference = reference_.method;
    result_.reference_error = reference_.error;
    for (BenchRow& row : result_.rows)
      if (row.errors && row.method == reference_.method) row.errors = reference_.error;
  }

  /// Replaces the first reference.
  void take_reference(const Finding& finding) {
    reference_.method = finding.method;
    reference_.run = finding.run;
    for (BenchRow& row : result_.rows)
      if (row.failure.empty()) row.errors = reference_.off(world_, record(row.method, watch_.stop_check));
  }

  /// Runs without records. The result must equal the row's. Returns the CPU time (s).
  double time_once(const BenchRow& row) const {
    const double start = cpu_time();
    const SimulationMethod& method = row.method;
    const Simulate settings = settings_of(scene_.simulate, method);
    if (bare_run(world_, scene_.initial, settings, method.steps, watch_.stop_check) != row.hash)
      throw runtime_error(fmt::format("the result differs from run to run of {}", full_name_of(method)));
    return cpu_time() - start;
  }

  void measure_crowds() {
    const BenchWatch rest{all_.stop_check, [this](double done, const string& what) {
                            all_.report_progress(share_ + (1 - share_) * done, what);
                          }};
    result_.qualities = measure_qualities(scene_, (1 - share_) * options_.budget, rest);
    if (!result_.qualities.cut.empty()) result_.left_out.push_back(result_.qualities.cut);
  }

  /// A row without repeats already has its time, from the only run that the budget allowed.
  void time_rows() {
    vector<BenchRow*> rows;
    vector<TimedTask> tasks;
    for (BenchRow& row : result_.rows) {
      if (!row.failure.empty() || row.repeats == 0) continue;
      rows.push_back(&row);
      tasks.push_back({[this, &row] { time_once(row); }, row.repeats});
    }

    const auto report_progress = [&](double done) { watch_.report_progress(0.5 + 0.5 * done, "timed runs"); };
    const vector<double> medians = time_in_turns(tasks, report_progress);
    for (size_t k = 0; k < rows.size(); ++k) rows[k]->cpu_s = medians[k];
    for (BenchRow& row : result_.rows) row.repeats = max(row.repeats, 1);
  }

  const Scene& scene_;
  const World& world_;
  const BenchOptions& options_;
  const BenchWatch& all_;
  BenchWatch watch_;  // of all but the qualities of crowds
  double share_ = 1;  // of the bench: all but the qualities
  const double start_ = cpu_time();
  double left_ = 0;       // s of CPU time for the rows
  vector<double> steps_;  // s, from the longest
  Reference reference_;
  optional<Evidence> evidence_;
  BenchResult result_;
};

}  // namespace

BenchResult run_bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch) {
  return Bench(scene, options, watch).go();
}

}  // namespace carom
