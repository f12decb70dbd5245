#pragma once
// One run, with what must be known of it to hold it against another one.
#include <cstdint>
#include <functional>
#include <vector>

#include "physics/entity.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "physics/world.h"
#include "run/engine.h"
#include "scene/simulate_settings.h"

namespace carom {

struct World;

/// What is compared of a collision. (The end of bounces is none, and is not kept.)
struct Impact {
  double time;            // s
  double approach_speed;  // m/s
  Entity a, b;            // as in Collision
  double impulse = 0;     // N s
};

struct RecordedRun {
  std::vector<State> states;    // at the instants asked for
  std::vector<Impact> impacts;  // by a, then b, then time
  double duration = 0;          // s
  Tally tally;                  // of the whole run
  std::uint64_t hash = 0;       // of the result (state_hash.h)
  double cpu_s = 0;

  /// m/s: slower collisions are bounces that die away, of which no two engines see the same number.
  double least_speed() const { return 0.01 * tally.max_speed; }
};

/// Runs from `initial` on to the end of simulate.duration, and looks at `instants` (s, ascending). `look` is called
/// now and then, and may throw. Throws SimulationError.
RecordedRun record_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                       const std::vector<double>& instants, const std::function<void()>& look);

/// The same run, neither looked at nor recorded: what is timed. Gives the result's hash.
std::uint64_t bare_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                       const std::function<void()>& look);

}  // namespace carom
