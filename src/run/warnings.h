#pragma once
// What makes a run's figures doubtful: what it says beside them.
#include <vector>

#include "files/summary.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "run/engine.h"

namespace carom {

struct Scene;

/// Of a run with this end and these sums. Where there are any, its status is `doubtful`.
std::vector<Warning> warnings_of(const Scene& scene, const EngineChoice& engine, const State& end,
                                 const Summary& summary, const Tally& tally);

}  // namespace carom
