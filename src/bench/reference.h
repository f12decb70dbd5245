#pragma once
// The reference of a scene's runs, the effect of rounding on it, and its own error.
//
// Rounding: the scene is run again in shifted coordinates (shifted.h), where every position has other last digits.
// The difference of the runs is the effect of rounding.
// If it moves a body by more than a hundredth of the largest radius, later collisions are others,
// and the scene is chaotic.
// Trajectories of a chaotic scene are compared until rounding has grown 2^14-fold.
// Beyond that, statistics are compared, and more shifted runs show how much these vary.

#include "bench/bench_options.h"
#include "bench/differences.h"
#include "bench/evidence.h"
#include "bench/method.h"
#include "bench/recorded_run.h"
#include "bench/statistics.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

struct Scene;

struct Reference {
  SimulationMethod method;  // exact, or stepped with dop853
  double duration = 0;      // s, of the scene
  /// In s. Of a chaotic scene those before the horizon, then those after it.
  vector<double> instants;
  /// Of a chaotic scene: the number before the horizon.
  size_t trajectory_instants = 0;
  RecordedRun run;
  /// In m: the greatest difference of shifted runs, at any instant.
  double rounding = 0;
  bool chaotic = false;
  double horizon = 0;  // s: trajectories are compared until then
  /// The effect of rounding until then, and of smaller step errors in islands. All methods share it.
  Differences rounded;
  /// The same. Of a stepped reference, also the effect of smaller step errors.
  Differences error;
  /// By dop853 where paths have closed forms. None: they are parabolas.
  optional<Finding> second;
  /// Of a chaotic scene, including the reference.
  optional<Ensemble> ensemble;

  Differences off(const World& world, const RecordedRun& other) const {
    return differences(world, run, other, instants, horizon);
  }
  Statistics statistics(const World& world, const RecordedRun& other) const {
    return statistics_of(world, other, duration, trajectory_instants);
  }
};

/// By options.reference, or by the exact engine if it supports the whole scene. A stepped reference uses dop853.
/// Throws SimulationError.
Reference make_reference(const Scene& scene, const BenchOptions& options, const BenchWatch& watch);

}  // namespace carom
