#pragma once
// Draws the charts of a finished run, into its own folder or another one.

#include "run/stored_charts.h"
#include "std.h"

namespace carom {

struct PlotRequest {
  const FormerRun* former = nullptr;
  /// The scene of the run. Its outputs are those that `folder` then has, `plots` included.
  const Scene* scene = nullptr;
  /// That of the run: its other files stay. Otherwise it becomes the folder of `carom run --only plots`.
  string folder;
  string gnuplot;  // its absolute path
};

/// Draws the possible charts. Until all are drawn the folder stays as it is. Throws ExportError, and what `watch`
/// throws.
void plot_run(const PlotRequest& request, const ReadingWatch& watch);

}  // namespace carom
