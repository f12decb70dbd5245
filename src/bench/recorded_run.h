#pragma once
// One run, with the data needed to compare it with another one.

#include "engine/engine.h"
#include "physics/entity.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "physics/world.h"
#include "scene/simulate_settings.h"
#include "std.h"

namespace carom {

/// The compared data of a collision. The end of bounces is not a collision and is left out.
struct Impact {
  double time;            // s
  double approach_speed;  // m/s
  Entity a, b;            // as in Collision
  double impulse = 0;     // N s
};

struct RecordedRun {
  vector<State> states;  // at the requested instants
  /// Sorted by a, then b, then time.
  vector<Impact> impacts;
  double duration = 0;  // s
  Tally tally;          // of the whole run
  /// Whether islands moved along paths that are not exact. All engines but the book's move them by the same code.
  bool inexact_islands = false;
  uint64_t hash = 0;  // of the result (state_hash.h)
  double cpu_s = 0;

  /// In m/s: the limit below which collisions are bounces that die away. Their number differs between engines.
  double least_speed() const { return 0.01 * tally.fastest.speed; }
};

/// Runs from `initial` to simulate.duration, and samples at `instants` (s, ascending).
/// `stop_check` is called from time to time, and may throw. Throws SimulationError.
RecordedRun record_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                       const vector<double>& instants, const function<void()>& stop_check);

/// The same run without samples and records, for timing. Returns the result's hash.
uint64_t bare_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                  const function<void()>& stop_check);

}  // namespace carom
