#pragma once
// A run's account at its end: where its energy and momentum went, and what it counted.
#include "files/summary.h"
#include "physics/state.h"
#include "run/engine.h"

namespace carom {

struct Scene;

/// The energy of all bodies at an instant.
struct StoredEnergy {
  double kinetic = 0, potential = 0;  // J
  double total() const { return kinetic + potential; }
};

StoredEnergy stored_energy(const Scene& scene, const State& state);

/// `start`: at time 0, the impulses given there counted; `end` and `tally`: of the end. Leaves open what is the
/// folder's: run, status, frames.
Summary account_of(const Scene& scene, const EngineChoice& engine, const StoredEnergy& start, const State& end,
                   const Tally& tally);

}  // namespace carom
