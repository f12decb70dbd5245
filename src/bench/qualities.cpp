#include "bench/qualities.h"

#include <fmt/format.h>

#include <random>

#include "bench/method.h"
#include "bench/timing.h"
#include "engine/engine.h"
#include "numerics/whole.h"
#include "physics/body_now.h"
#include "physics/world.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t samples = 64;  // instants
constexpr size_t most_runs = 6;
constexpr size_t least_runs = 3;

/// What is kept of a run.
struct QualityRun {
  vector<double> taken;  // J, up to each instant
  double height = 0;     // m
  Tally tally;
  double cpu_s = 0;
};

using QualityRuns = vector<QualityRun>;

/// The mean of of(run) over runs, and its variance.
struct RunMean {
  double value = 0;
  double variance = 0;
};

template <typename Of>
RunMean mean_over(const QualityRuns& runs, const Of& of) {
  const auto count = double(runs.size());
  RunMean mean;
  for (const QualityRun& run : runs) mean.value += of(run) / count;
  for (const QualityRun& run : runs) mean.variance += pow(of(run) - mean.value, 2) / (count * (count - 1));
  return mean;
}

/// In m, of the centre of mass above the lowest surface of a body.
double height_of_heap(const World& world, const State& state) {
  const Vec3 up = -world.gravity.normalized();
  double mass = 0;
  double moment = 0;
  double lowest = infinity;

  for (Entity i = 0; i < world.body_count(); ++i) {
    const double of_body = mass_now(world, state, i);
    if (of_body == 0) continue;  // it has left the world
    const double height = up.dot(state.position[i]);
    mass += of_body;
    moment += of_body * height;
    lowest = min(lowest, height - radius_now(world, state, i));
  }

  return moment / mass - lowest;
}

/// The same start with other velocities at random: by a hundredth of the speed of falling by a radius, or a thousandth
/// of the greatest speed. Rounding would grow so slowly that runs have much of their impacts in common.
State disturbed(const World& world, State state, int number) {
  double size = 0.01 * sqrt(2 * world.gravity.norm() * *ranges::min_element(world.radius));
  for (const Vec3& v : state.velocity) size = max(size, 0.001 * v.norm());
  std::mt19937_64 draw{uint64_t(number)};
  for (Vec3& v : state.velocity)
    for (int axis = 0; axis < 3; ++axis) v[axis] += size * (double(draw() >> 11) * 0x1p-52 - 1);
  return state;
}

class QualityBench {
 public:
  QualityBench(const Scene& scene, double budget, const BenchWatch& watch)
      : scene_(scene), budget_(budget), watch_(watch) {
    for (size_t k = 1; k <= samples; ++k) instants_.push_back(scene.simulate.duration * double(k) / samples);
  }

  QualityCurve go() {
    QualityCurve curve;
    const double once = run_each_once(curve);
    const auto affordable = size_t(whole_below(once > 0 ? budget_ / once : 0));
    curve.runs = clamp(affordable, least_runs, most_runs);
    repeat(curve);

    // Nothing is compared with the reference alone.
    if (runs_.size() < 2) return curve;
    for (size_t level = 0; level < runs_.size(); ++level) curve.rows.push_back(row_of(level));
    return curve;
  }

 private:
  static string cut_at(size_t level, const string& why) {
    return fmt::format("quality {} and finer: {}", name_of(static_cast<QualityLevel>(level)), why);
  }

  /// As long as three runs of all fit. Returns their time (s).
  double run_each_once(QualityCurve& curve) {
    double once = 0;
    for (size_t level = 0; level < contact_qualities.size() && curve.cut.empty(); ++level) {
      try {
        runs_.push_back({run(level, 1, stop_check_within(budget_ / least_runs - once, watch_.stop_check))});
        once += runs_.back().front().cpu_s;
      } catch (const Overrun&) {
        curve.cut = cut_at(level, fmt::format("three runs exceed {:.2g} s of CPU time", budget_));
      } catch (const SimulationError& error) {
        curve.cut = cut_at(level, error.what());
      }
    }
    return once;
  }

  void repeat(QualityCurve& curve) {
    for (size_t level = 0; level < runs_.size(); ++level) {
      try {
        for (size_t number = 2; number <= curve.runs; ++number)
          runs_[level].push_back(run(level, int(number), watch_.stop_check));
      } catch (const SimulationError& error) {
        curve.cut = cut_at(level, error.what());
        runs_.resize(level);
      }
    }
  }

  QualityRun run(size_t level, int number, const function<void()>& stop_check) {
    const auto quality = static_cast<QualityLevel>(level);
    watch_.report_progress(min(1.0, spent_ / budget_), fmt::format("quality {}", name_of(quality)));
    Simulate settings = settings_of(scene_.simulate, {});
    settings.contact.quality = quality;
    const World& world = scene_.world;
    const double start = cpu_time();
    const auto simulator = make_simulator(world, disturbed(world, scene_.initial, number), settings, {}, {});

    QualityRun kept;
    for (const double instant : instants_) {
      while (simulator->time() < instant) {
        stop_check();
        simulator->advance_to(instant);
      }
      kept.taken.push_back(simulator->tally().energy_lost);
    }
    kept.cpu_s = cpu_time() - start;
    kept.tally = simulator->tally();
    if (world.gravity.norm() > 0) kept.height = height_of_heap(world, simulator->state());
    spent_ += kept.cpu_s;
    return kept;
  }

  QualityRow row_of(size_t level) const {
    const QualityRuns& runs = runs_[level];
    const QualityRuns& reference = runs_.back();
    QualityRow row;
    row.level = static_cast<QualityLevel>(level);

    vector<double> times;
    for (const QualityRun& run : runs) {
      times.push_back(run.cpu_s);
      row.max_overlap = max(row.max_overlap, run.tally.max_overlap);
    }

    std::nth_element(times.begin(), times.begin() + ptrdiff_t(times.size() / 2), times.end());
    row.cpu_s = times[times.size() / 2];

    row.made = mean_over(runs, [](const QualityRun& run) { return run.tally.doubts.contact_made; }).value;
    row.unsolved = mean_over(runs, [](const QualityRun& run) {
                     const Doubts& doubts = run.tally.doubts;
                     return double(doubts.unsolved_steps) / max(1.0, double(doubts.crowd_steps));
                   }).value;

    // The energy that is taken, over time.
    double squares = 0;
    double variance = 0;
    for (size_t k = 0; k < instants_.size(); ++k) {
      const auto taken = [k](const QualityRun& run) { return run.taken[k]; };
      const RunMean here = mean_over(runs, taken);
      const RunMean there = mean_over(reference, taken);
      squares += pow(here.value - there.value, 2) / samples;
      variance += (here.variance + there.variance) / samples;
    }
    const double all = std::abs(mean_over(reference, [](const QualityRun& run) { return run.taken.back(); }).value);
    row.dissipated = {sqrt(squares) / all, sqrt(variance) / all};

    if (!(scene_.world.gravity.norm() > 0)) return row;
    const auto height = [](const QualityRun& run) { return run.height; };
    const RunMean here = mean_over(runs, height);
    const RunMean there = mean_over(reference, height);
    row.height = {here.value / there.value - 1, sqrt(here.variance + there.variance) / there.value};
    return row;
  }

  const Scene& scene_;
  double budget_;
  const BenchWatch& watch_;
  vector<double> instants_;
  vector<QualityRuns> runs_;  // by level
  double spent_ = 0;          // s
};

}  // namespace

QualityCurve measure_qualities(const Scene& scene, double budget, const BenchWatch& watch) {
  return QualityBench(scene, budget, watch).go();
}

}  // namespace carom
