#pragma once
// `table`: the balls of a group come from a CSV file.

#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Gives each group with a `table` its balls as `members`, one for each line of the file. In the tree these are then
/// values of the scene, as if its author had written them, with their places in the file. `root`: the tree without
/// expressions, not checked yet: what is wrong with the group itself stays as it is. `folder`: that of the scene file.
/// Adds the files to `sources` and to `made_from`, and errors of a line with its file, line and column.
void apply_tables(Node& root, const string& folder, vector<Source>& sources, MadeFrom& made_from,
                  Diagnostics& diagnostics);

}  // namespace carom
