#pragma once
// The exact simulator's parts, put together without its loop.

#include "simulate/build.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/crowd/crowd_motion.h"
#include "simulate/impact/body_merging.h"
#include "simulate/impact/impacts.h"
#include "simulate/impact/stall_guard.h"
#include "simulate/island/constrained_motion.h"
#include "simulate/path/crossings.h"
#include "simulate/path/path_log.h"
#include "std.h"

namespace carom {

struct ExactParts {
  explicit ExactParts(Problem given)
      : problem(std::move(given)),
        bodies(problem.world, problem.options),
        crossings(bodies, [this](Entity i) { return bodies.flight_end(i); }),
        paths(bodies, crossings),
        collapses(bodies),
        // Ways to move.
        modes(bodies),
        flat(bodies, modes, collapses),
        group(bodies, modes, flat, collapses, paths),
        flights(bodies, flat, paths),
        crowds(bodies, modes, group, flights),
        constrained(bodies, modes, group, flat, collapses, flights),
        merging(bodies, modes, group, flat, flights, paths),
        // What impacts need.
        guard(problem.world.body_count(), problem.options.duration),
        all_impacts(bodies, {collapses, flat, group, flights, merging, guard}),
        impacts(all_impacts.of_two) {
    for (Entity i = 0; i < bodies.world.body_count(); ++i)
      bodies.flights.set(i, {{}, problem.initial.position[i], problem.initial.velocity[i], problem.world.gravity});
    bodies.neighbours.start(problem.initial.position);
  }

  const Problem problem;
  ExactBodies bodies;
  Crossings crossings;
  PathLog paths;
  CollapseDetector collapses;
  ModeChanges modes;
  FlatContacts flat;
  ExactGroup group;
  FlightChanges flights;
  CrowdMotion crowds;
  ConstrainedMotion constrained;
  BodyMerging merging;
  StallGuard guard;
  Impacts all_impacts;
  ExactImpacts& impacts;
};

}  // namespace carom
