#pragma once
// The charts of a run, gathered from its states and collisions, or from its tables. Memory depends on the number of
// bodies, not on that of instants.

#include "export/collisions_chart.h"
#include "export/energy_chart.h"
#include "export/heights_chart.h"
#include "export/speeds_chart.h"
#include "export/timeline.h"
#include "std.h"

namespace carom {

struct Scene;

/// When states are sampled for the energy, and for the heights: as for energy.csv and trajectory.csv, where the scene
/// lists these, else at plot_instants even ones.
struct ChartTicks {
  explicit ChartTicks(const Scene& scene);
  Ticks energy, heights;
};

/// All charts of a run. Fill each member, or let sample() do it.
struct RunCharts {
  /// `scene` must outlive this object.
  explicit RunCharts(const Scene& scene);

  /// Takes what the charts show of a state at its time (s). Times ascend, and are those of `instants`, or others.
  void sample(double time, const State& state);

  void keep(auto& archive) { archive(energy, heights, speeds, collisions, next_energy_, next_heights_); }

  EnergyChart energy;
  HeightsChart heights;
  SpeedsChart speeds;
  CollisionsChart collisions;
  ChartTicks ticks;

 private:
  const Scene& scene_;
  int64_t next_energy_, next_heights_;
};

inline constexpr int64_t plot_instants = 501;

/// One chart as a row of a table.
struct RunChart {
  string_view name;  // of its files: plots/<name>.svg and plots/<name>.png
  Plot (*plot)(const RunCharts& charts);
};

/// In the order of plot_files.names (scene/output_kinds.h).
span<const RunChart> run_charts();

/// A file of plots/.
struct ChartFile {
  string name, bytes;
};
/// Draws the named charts, each as two files. Throws ExportError.
vector<ChartFile> draw_charts(span<const string_view> names, const RunCharts& charts, const string& gnuplot);

}  // namespace carom
