#pragma once
// The charts of a finished run, from what its folder holds: the paths of its bodies, or its tables.

#include "export/run_charts.h"
#include "files/part_file.h"
#include "run/former_run.h"
#include "std.h"

namespace carom {

/// The charts that the files of a run suffice for.
struct PossibleCharts {
  vector<string_view> names;
  /// The others, each with the key of the scene that would give it.
  vector<LeftOut> missing;
};
PossibleCharts possible_charts(const FormerRun& former);

/// Whether a file of this name, relative to a run's folder, is that of a possible chart.
bool is_drawn_by(const PossibleCharts& charts, string_view file);

/// Called often while files are read, with the part that is done, 0 to 1. May throw.
using ReadingWatch = function<void(double done)>;

/// Fills what the possible charts show. `scene`: that of the run, with `plots` among its outputs.
/// With flights the states are those at the ticks of the charts, otherwise the rows of the tables, which are the same.
/// Throws ExportError, and what `watch` throws.
void read_charts(const FormerRun& former, const Scene& scene, RunCharts& charts, const ReadingWatch& watch);

}  // namespace carom
