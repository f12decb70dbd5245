#pragma once
// Run time against error: one scene by every engine, integrator and step, held against a reference.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_options.h"
#include "bench/differences.h"
#include "bench/evidence.h"
#include "bench/method.h"
#include "bench/statistics.h"

namespace carom {

struct Scene;

/// A method, what it costs and how far off it is.
struct BenchRow {
  SimulationMethod method;
  std::string failure;  // empty: the run came to its end, and all of the rest is there
  double cpu_s = 0;     // of one run, the median of `repeats`
  int repeats = 0;
  std::optional<Differences> errors;  // none: at no instant has the motion one trajectory only
  double max_overlap = 0;             // m
  std::uint64_t collisions = 0;
  std::uint64_t hash = 0;
  // Of a chaotic scene:
  Statistics statistics;      // without speeds
  double speed_distance = 0;  // Kolmogorov and Smirnov's, from the ensemble's speeds
  Deviation deviation;        // from the ensemble's means
};

struct BenchResult {
  SimulationMethod reference;
  Differences reference_error;     // an estimate (evidence.h)
  std::vector<Witness> witnesses;  // what other methods say of it
  double rounding = 0;             // m: by how much runs in shifted coordinates differ, anywhere at any instant
  bool chaotic = false;
  double horizon = 0;       // s: trajectories are compared until then
  std::size_t members = 0;  // of the ensemble of a chaotic scene, the reference included
  Statistics mean;          // of the ensemble
  std::vector<BenchRow> rows;
  std::vector<std::string> left_out;  // a line for each engine, or engine's steps, that have no row
  double cpu_s = 0;                   // of it all
};

struct BenchWatch {
  std::function<void()> look;                                      // called often; may throw
  std::function<void(double done, const std::string& what)> tell;  // done: 0 to 1
};

/// Throws SimulationError where there is no reference; std::runtime_error where a run's result is not that of the one
/// before.
BenchResult run_bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch);

/// m: 2^-53 of the scene's extent, below which a distance is rounding.
double rounding_of(const Scene& scene);

}  // namespace carom
