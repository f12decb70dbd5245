#pragma once
// The --grid options of the command line as a sweep file.

#include "scene/sweep.h"
#include "std.h"

namespace carom {

/// Whether it is a range to draw samples from: "path=from:to" or "path=from:to:log".
bool is_open_range(const string& grid);

/// The text of a sweep file. What is no range is a list of values; errors in it are found when the text is read.
string grid_text(const string& base, const vector<string>& grids, const SweepOptions& options);

}  // namespace carom
