#pragma once
// The exact simulator's parts, put together without its loop.
#include <utility>

#include "simulate/body_merging.h"
#include "simulate/build.h"
#include "simulate/collapse_detector.h"
#include "simulate/constrained_motion.h"
#include "simulate/crossings.h"
#include "simulate/event_predictor.h"
#include "simulate/event_prefetch.h"
#include "simulate/exact_group.h"
#include "simulate/exact_impacts.h"
#include "simulate/flight_changes.h"
#include "simulate/path_log.h"
#include "simulate/simultaneous_impacts.h"
#include "simulate/stall_guard.h"
#include "simulate/time_stepping.h"

namespace carom {

struct ExactParts {
  explicit ExactParts(Problem given)
      : problem(std::move(given)),
        bodies(problem.world, problem.options),
        crossings(bodies),
        paths(bodies, crossings),
        collapses(bodies),
        modes(bodies),
        flat(bodies, modes, collapses),
        group(bodies, modes, flat, collapses, paths),
        flights(bodies, flat, paths),
        queue(bodies),
        prefetch(bodies, queue),
        predictor(bodies, queue, modes, flat, group),
        simultaneous(bodies, group, flights),
        stepping(bodies, modes, group, flights),
        constrained(bodies, modes, group, flat, collapses, flights),
        merging(bodies, modes, flat, flights, paths),
        guard(problem.world.body_count(), problem.options.duration),
        impacts(bodies, {collapses, flat, group, flights, simultaneous, merging, guard}) {
    for (Entity i = 0; i < bodies.world.body_count(); ++i)
      bodies.flights.set(i, {{}, problem.initial.position[i], problem.initial.velocity[i], problem.world.gravity});
    bodies.neighbours.start(problem.initial.position);
  }

  const Problem problem;
  ExactBodies bodies;
  Crossings crossings;
  PathLog paths;
  CollapseDetector collapses;
  Modes modes;
  FlatContacts flat;
  ExactGroup group;
  FlightChanges flights;
  EventQueue queue;
  EventPrefetch prefetch;
  EventPredictor predictor;
  SimultaneousImpacts simultaneous;
  TimeStepping stepping;
  ConstrainedMotion constrained;
  BodyMerging merging;
  StallGuard guard;
  ExactImpacts impacts;
};

}  // namespace carom
