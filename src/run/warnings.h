#pragma once
// The warnings of a run with doubtful results.

#include "engine/engine.h"
#include "files/summary.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "std.h"

namespace carom {

struct Scene;

/// The warnings of a run with this end and these sums. With any, its status is `doubtful`.
vector<Warning> warnings_of(const Scene& scene, const EngineChoice& engine, const State& end, const Summary& summary,
                            const Tally& tally);

}  // namespace carom
