#pragma once
// The --grid options of the command line as a sweep file.
#include <string>
#include <vector>

#include "scene/sweep.h"

namespace carom {

/// Whether it is a range to draw samples from: "path=from:to" or "path=from:to:log".
bool is_open_range(const std::string& grid);

/// The text of a sweep file. What is no range is a list of values; errors in it are found when the text is read.
std::string grid_text(const std::string& base, const std::vector<std::string>& grids, const SweepOptions& options);

}  // namespace carom
