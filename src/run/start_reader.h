#pragma once
// The states of former runs, for scenes that begin with one.

#include "scene/former_state.h"
#include "scene/load.h"
#include "std.h"

namespace carom {

/// A reader of runs for LoadOptions::former_state. With flights a run has every state from its start to its end, bit
/// for bit. Without them it has those of its trajectory.csv. A run is checked by its hashes when it is read, and the
/// reader keeps the last one in memory. `options`: for the scenes of the runs; of them mesh_points is used.
function<FormerState(const string& folder, optional<double> at)> start_reader(const LoadOptions& options);

}  // namespace carom
