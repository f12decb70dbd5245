#pragma once
// The totals of a run at its end: its energy, its momentum and its counts.
#include "engine/engine.h"
#include "files/summary.h"
#include "physics/state.h"

namespace carom {

struct Scene;

/// The energy of all bodies at an instant.
struct StoredEnergy {
  double kinetic = 0, potential = 0;  // J
  double total() const { return kinetic + potential; }
};

StoredEnergy stored_energy(const Scene& scene, const State& state);

/// `start`: at time 0, with the impulses given there. `end` and `tally`: at the end.
/// The members run, status and frames stay open, because they depend on the folder.
Summary account_of(const Scene& scene, const EngineChoice& engine, const StoredEnergy& start, const State& end,
                   const Tally& tally);

}  // namespace carom
