#pragma once
// Runs with regions, for tests.

#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {

struct WithRegions : Outcome {
  vector<RegionCrossing> crossings;
};

inline WithRegions run_with(const Problem& problem, double slice = 1e9) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  WithRegions run;
  double time = 0;

  while (simulator->time() < problem.options.duration) {
    time = std::min(std::max(time, simulator->time()) + slice, problem.options.duration);
    simulator->advance_to(time);
    run.crossings.insert(run.crossings.end(), simulator->crossings().begin(), simulator->crossings().end());
    run.all.insert(run.all.end(), simulator->collisions().begin(), simulator->collisions().end());
  }

  run.end = simulator->state();
  run.tally = simulator->tally();
  return run;
}

inline WorldRegion region_at(const Vec3& position, const Volume& volume) {
  WorldRegion region;
  region.position = position;
  region.volume = volume;
  return region;
}

inline WorldRegion side_at(const Vec3& point, const Vec3& normal) {
  WorldRegion region;
  region.position = point;
  region.normal = normal.normalized();
  return region;
}

inline WorldRegion removing(WorldRegion region) {
  region.removes = true;
  return region;
}

inline WorldRegion stopping(WorldRegion region) {
  region.stops = true;
  return region;
}

/// J, what the balance leaves.
inline double left(const Problem& problem, const WithRegions& run) {
  return residual(problem, run) + run.tally.changes.removed.energy;
}

/// A gas of balls in a box, with regions of every shape.
inline Problem gas_among_regions(int count) {
  Problem problem;
  problem.room({-2, -2, -2}, {2, 2, 2});
  Random random;
  for (int i = 0; i < count; ++i)
    problem.ball({-1.5 + (i % 4), -1.5 + (i / 4 % 4), -1.5 + (i / 16 % 4)}, in_cube(random, 2), 1, 0.2);
  problem.world.regions = {region_at({0.3, 0.2, 0.1}, Volume::sphere(0.9)),
                           region_at({0.3, -0.2, 0.1}, Volume::cylinder(0.8, 1.5)),
                           region_at({-0.3, 0.2, 0.4}, Volume::box({1, 2, 1.5})), side_at({0.1, 0, 0}, {1, 2, 3})};
  problem.options.duration = 4;
  return problem;
}

}  // namespace carom
