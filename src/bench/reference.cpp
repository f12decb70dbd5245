// Runs the reference method at its place and in shifted coordinates, and compares the runs to measure rounding.
// In shifted coordinates every position has other last digits, while the exact motion is the same.
#include "bench/reference.h"

#include <fmt/format.h>

#include "bench/shifted.h"
#include "bench/timing.h"
#include "engine/accuracy.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace {

constexpr int shifted_runs = 3;
constexpr int ensemble_runs = 12;
constexpr double astray = 0.01;  // of the largest radius
constexpr double grown = 0x1p14;

class Making {
 public:
  Making(const Scene& scene, const BenchOptions& options, const BenchWatch& watch)
      : scene_(scene), world_(scene.world), options_(options), watch_(watch) {}

  Reference go() {
    watch_.report_progress(0, "the reference");
    SimulationMethod& method = reference_.method;
    const bool exact_runs = unsupported(world_, settings_of(scene_.simulate, method)).empty();
    method.engine = options_.reference.value_or(exact_runs ? Engine::exact : Engine::stepped);
    if (method.engine == Engine::stepped) method = dop853(world_, exact_tolerance::step_error);

    reference_.duration = scene_.simulate.duration;
    if (const auto lacks = unsupported(world_, settings_of(scene_.simulate, method)); !lacks.empty())
      throw SimulationError("there is no reference: " + lacks.front().what);

    try {
      run();
    } catch (const Overrun&) {
      throw SimulationError(
          fmt::format("the reference, by {}, exceeds the budget of {} s: raise it (--budget), or "
                      "shorten simulate.duration",
                      name_of(reference_.method), options_.budget));
    }
    return std::move(reference_);
  }

 private:
  double spent() const { return cpu_time() - start_; }

  RecordedRun record(const World& world, const State& initial, const SimulationMethod& method) const {
    return record_run(world, initial, settings_of(scene_.simulate, method), method.steps, reference_.instants,
                      stop_check_within(0.5 * options_.budget, watch_.stop_check));
  }

  void run() {
    const double duration = scene_.simulate.duration;
    reference_.instants = uneven_instants(0, duration, world_.body_count());
    reference_.run = record(world_, scene_.initial, reference_.method);
    const double once = reference_.run.cpu_s;

    // The same in shifted coordinates, as often as time allows.
    vector<RecordedRun> others;
    for (int k = 1; k <= shifted_runs && (k == 1 || (k + 1) * once < 0.2 * options_.budget); ++k)
      others.push_back(shifted_run(k, reference_.method));

    judge(others);
    if (reference_.chaotic) {
      gather_ensemble();
    } else {
      for (const RecordedRun& other : others) take_rounding(other);
    }
    if (reference_.horizon > 0 && reference_.run.inexact_islands) take_smaller_steps();

    // The error of the reference, and another method to check it.
    reference_.error = reference_.rounded;
    if (!(reference_.horizon > 0) || varying_force(world_) == nullptr) return;
    watch_.report_progress(0, "dop853");
    const SimulationMethod fine = dop853(world_, exact_tolerance::step_error / accuracy_tolerance::finer);
    if (reference_.method.engine == Engine::stepped) {
      reference_.error = larger(reference_.error, reference_.off(world_, record(world_, scene_.initial, fine)));
    } else {
      find_another(fine);
    }
  }

  /// Adds the effect of smaller step errors in islands to that of rounding.
  void take_smaller_steps() {
    SimulationMethod fine = reference_.method;
    fine.steps.error = exact_tolerance::step_error / accuracy_tolerance::finer;
    reference_.rounded = larger(reference_.rounded, reference_.off(world_, record(world_, scene_.initial, fine)));
  }

  /// Adds a run by dop853 as an independent check. One that takes too long or fails is left out.
  void find_another(const SimulationMethod& fine) {
    if (!unsupported(world_, settings_of(scene_.simulate, fine)).empty()) return;
    try {
      const RecordedRun coarse = record(world_, scene_.initial, dop853(world_, exact_tolerance::step_error));
      // In shifted coordinates, so that the effect of rounding in this many steps shows.
      Finding other{fine, shifted_run(1, fine), {}};
      other.error =
          larger(reference_.rounded, differences(world_, coarse, other.run, reference_.instants, reference_.horizon));
      reference_.second = std::move(other);
    } catch (const Overrun&) {
    } catch (const SimulationError&) {
    }
  }

  RecordedRun shifted_run(int number, const SimulationMethod& method) const {
    const Vec3 by = shift(extent(world_, scene_.initial), number);
    const World world = shifted(world_, by);
    RecordedRun run = record(world, shifted(scene_.initial, by), method);
    for (State& state : run.states) state = shifted(std::move(state), -by);
    return run;
  }

  void take_rounding(const RecordedRun& other) {
    reference_.rounded = larger(reference_.rounded, reference_.off(world_, other));
  }

  /// Determines whether rounding grows until trajectories are meaningless, and until when they are comparable.
  void judge(const vector<RecordedRun>& others) {
    const double first = rounding_of(world_, scene_.initial);
    double until = 0;
    for (size_t k = 0; k < reference_.instants.size(); ++k) {
      for (const RecordedRun& other : others)
        for (Entity i = 0; i < world_.body_count(); ++i)
          reference_.rounding =
              max(reference_.rounding, (other.states[k].position[i] - reference_.run.states[k].position[i]).norm());
      if (reference_.rounding <= grown * first) until = reference_.instants[k];
    }
    reference_.chaotic = reference_.rounding > astray * *ranges::max_element(world_.radius);
    reference_.horizon = reference_.chaotic ? until : scene_.simulate.duration;
  }

  /// Samples the reference and more shifted runs before the horizon, and then after it.
  void gather_ensemble() {
    vector<double>& instants = reference_.instants;
    instants = uneven_instants(0, reference_.horizon, world_.body_count());
    if (!(reference_.horizon > 0)) instants.clear();
    reference_.trajectory_instants = instants.size();
    for (const double later : uneven_instants(reference_.horizon, scene_.simulate.duration, world_.body_count()))
      instants.push_back(later);

    reference_.run = record(world_, scene_.initial, reference_.method);
    vector<Statistics> members = {reference_.statistics(world_, reference_.run)};

    for (int k = 1; k <= ensemble_runs; ++k) {
      if (k > 3 && spent() + reference_.run.cpu_s > 0.5 * options_.budget) break;
      watch_.report_progress(0, "the reference, shifted");
      const RecordedRun run = shifted_run(k, reference_.method);
      members.push_back(reference_.statistics(world_, run));
      take_rounding(run);
    }
    reference_.ensemble.emplace(std::move(members));
  }

  const Scene& scene_;
  const World& world_;
  const BenchOptions& options_;
  const BenchWatch& watch_;
  const double start_ = cpu_time();
  Reference reference_;
};

}  // namespace

Reference make_reference(const Scene& scene, const BenchOptions& options, const BenchWatch& watch) {
  return Making(scene, options, watch).go();
}

}  // namespace carom
