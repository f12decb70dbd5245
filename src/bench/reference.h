#pragma once
// What a scene's runs are held against, what rounding does to it, and how far off it may be itself.
//
// Rounding. The scene is run again in shifted coordinates (shifted.h), where every place has other last digits. What
// differs then is what rounding does. Where it moves a body by more than a hundredth of the largest radius, others meet
// in the end than would have met, and the scene is chaotic: its trajectories are compared only until rounding has grown
// 2^14-fold; beyond, its statistics are, and more shifted runs say how much these may differ.
#include <functional>
#include <optional>
#include <vector>

#include "bench/bench.h"
#include "bench/differences.h"
#include "bench/evidence.h"
#include "bench/method.h"
#include "bench/recorded_run.h"
#include "bench/statistics.h"
#include "physics/world.h"

namespace carom {

struct Scene;

/// A run takes more CPU time than it may.
struct Overrun {};

/// Calls `look`, and throws Overrun once more than `share` (s) of CPU time have gone by since now.
std::function<void()> look_within(double share, const std::function<void()>& look);

struct Reference {
  SimulationMethod method;              // exact, or stepped by dop853
  double duration = 0;                  // s, of the scene
  std::vector<double> instants;         // s; of a chaotic scene those before the horizon, then those behind it
  std::size_t trajectory_instants = 0;  // of a chaotic scene: how many lie before the horizon
  RecordedRun run;
  double rounding = 0;  // m: by how much shifted runs differ, anywhere at any instant
  bool chaotic = false;
  double horizon = 0;                // s: trajectories are compared until then
  Differences rounded;               // what rounding does until then,
  Differences error;                 // and, of a stepped one, smaller step errors
  std::optional<Finding> second;     // by dop853 where paths have closed forms; none: they are parabolas
  std::optional<Ensemble> ensemble;  // of a chaotic scene, itself included

  Differences off(const World& world, const RecordedRun& other) const {
    return differences(world, run, other, instants, horizon);
  }
  Statistics statistics(const World& world, const RecordedRun& other) const {
    return statistics_of(world, other, duration, trajectory_instants);
  }
};

/// By options.reference, or the exact engine if it has all that the scene asks for; a stepped one by dop853. Throws
/// SimulationError.
Reference make_reference(const Scene& scene, const BenchOptions& options, const BenchWatch& watch);

}  // namespace carom
