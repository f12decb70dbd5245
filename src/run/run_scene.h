#pragma once
// Runs checked scenes into their folders: joins simulator, timelines, renderers and exports.

#include "engine/engine.h"
#include "run/run_settings.h"
#include "run/stage.h"
#include "std.h"

namespace carom {

/// Simulates once, writes the tables of each show on the way, and draws from the record of the motion.
/// Throws SimulationError, what `watch.stop_check` throws, and, for a single show, its failure.
/// Then only complete files stay.
vector<RunResult> run_shows(span<const Show> shows, const EngineChoice& engine, const RunSettings& settings,
                            const RunWatch& watch);

/// The same for one scene.
RunResult run_scene(const Show& show, const EngineChoice& engine, const RunSettings& settings, const RunWatch& watch);

}  // namespace carom
