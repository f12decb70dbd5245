#pragma once
// What the parts of the stepped simulator share.
#include "physics/bounds.h"
#include "simulate/event_log.h"
#include "simulate/simulation_error.h"
#include "simulate/stepped.h"
#include "simulate/stepped_awake.h"
#include "simulate/stepped_bounces.h"
#include "simulate/stepped_clock.h"
#include "simulate/stepped_clusters.h"
#include "simulate/stepped_free_motion.h"
#include "simulate/stepped_group_members.h"
#include "simulate/stepped_paths.h"

namespace carom {

struct StepShared {
  /// All bodies at time 0, after the world's impulses. `world` must outlive this.
  StepShared(const World& world, const State& initial, const SteppedOptions& options);
  StepShared(const StepShared&) = delete;
  StepShared& operator=(const StepShared&) = delete;

  /// Whether contact forces shape body i's path.
  bool constrained(Entity i) const { return clusters.holds(i) || group.in_step(i); }
  /// Throws SimulationError if body i is too far or too fast at x (m) and v (m/s).
  void check_bounds(Entity i, const Vec3& x, const Vec3& v) const {
    hold_to(bounds, i, clock.to(), x, v,
            "use a smaller simulate.step, an attractor with `softening`, or restitution of at most 1");
  }

  const World& world;
  const SteppedOptions options;
  const Bounds bounds;
  EventLog log;
  StepClock clock;
  FreeMotion free;
  BounceLimits bounces;
  StepPaths paths;
  Clusters clusters;
  AwakeBodies awake;
  GroupMembers group;
};

}  // namespace carom
