#pragma once
// Run time against error: one scene by every engine, integrator and step, compared with a reference.

#include "bench/bench_options.h"
#include "bench/differences.h"
#include "bench/evidence.h"
#include "bench/method.h"
#include "bench/qualities.h"
#include "bench/statistics.h"
#include "std.h"

namespace carom {

struct Scene;

/// A method, its cost and its error.
struct BenchRow {
  SimulationMethod method;
  /// Empty: the run reached its end.
  string failure;
  /// Of one run, the median of `repeats`.
  double cpu_s = 0;
  int repeats = 0;
  /// None: the motion has no unique trajectory at any instant.
  optional<Differences> errors;
  double max_overlap = 0;  // m
  uint64_t collisions = 0;
  uint64_t hash = 0;
  // The following are of a chaotic scene.
  Statistics statistics;      // without speeds
  double speed_distance = 0;  // Kolmogorov-Smirnov distance from the ensemble's speeds
  Deviation deviation;        // from the ensemble's means
};

struct BenchResult {
  SimulationMethod reference;
  Differences reference_error;  // an estimate (evidence.h)
  vector<Witness> witnesses;    // comparisons with other methods
  /// Whether islands move along paths that are not exact: in that these methods are no witnesses of one another.
  bool inexact_islands = false;
  /// In m: the greatest difference of runs in shifted coordinates, at any instant.
  double rounding = 0;
  bool chaotic = false;
  double horizon = 0;  // s: trajectories are compared until then
  /// Of the ensemble of a chaotic scene, including the reference.
  size_t members = 0;
  Statistics mean;  // of the ensemble
  vector<BenchRow> rows;
  QualityCurve qualities;
  /// A line for each engine, or for an engine's steps, without a row.
  vector<string> left_out;
  double cpu_s = 0;  // of the whole bench
};

/// Throws SimulationError if there is no reference, and runtime_error if a repeated run has a different result.
BenchResult run_bench(const Scene& scene, const BenchOptions& options, const BenchWatch& watch);

}  // namespace carom
