#pragma once
// `start`: bodies begin as a former run had them.

#include "scene/load_options.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Gives each body that the former run has its position and velocity there, and no impulse. In the tree these are then
/// numbers of the scene, as if its author had written them, with the place of `start`. A group gets `members`.
/// Bodies that the run lacks stay as they are. `root`: the checked tree. `folder`: that of the scene file.
/// Adds errors where the run has no such state, and where its bodies do not match. `made_from` receives the run, and
/// notes on what the author may not expect.
void apply_start(Node& root, const string& folder, const LoadOptions& options, MadeFrom& made_from,
                 Diagnostics& diagnostics);

}  // namespace carom
