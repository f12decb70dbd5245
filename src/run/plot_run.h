#pragma once
// Draws the charts of a finished run, into its own folder or another one.
#include <functional>
#include <string>

#include "run/stored_charts.h"

namespace carom {

struct PlotRequest {
  const FormerRun* former = nullptr;
  /// The scene of the run. Its outputs are those that `folder` then has, `plots` included.
  const Scene* scene = nullptr;
  /// That of the run: its other files stay. Otherwise it becomes the folder of `carom run --only plots`.
  std::string folder;
  std::string gnuplot;  // its absolute path
};

/// Draws the possible charts; until all are drawn the folder stays as it is. Throws ExportError, and what `stop_check`
/// throws.
void plot_run(const PlotRequest& request, const std::function<void()>& stop_check);

}  // namespace carom
