// Only what the charts show is kept of a run. gnuplot runs once at the end, so that a run does not wait for it.
#include "export/plots_writer.h"

#include "export/gnuplot.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

PlotsWriter::PlotsWriter(FolderWriter& folder, const Scene& scene)
    : gnuplot_(find_gnuplot()), charts_(scene), series_(folder, plot_files) {}

void PlotsWriter::record(span<const Collision> collisions) {
  for (const Collision& collision : collisions) charts_.collisions.add(collision.time, collision.kind);
}

void PlotsWriter::add(double time, const State& state, span<const ContactForce>) {
  charts_.sample(time, state);
}

vector<OutputFile*> PlotsWriter::files() {
  vector<string_view> names;
  for (const RunChart& chart : run_charts()) names.push_back(chart.name);
  for (const ChartFile& file : draw_charts(names, charts_, gnuplot_)) series_.put(file.name, file.bytes);
  return {};
}

vector<Ticks> PlotsWriter::ticks(const Scene& scene) {
  const ChartTicks ticks(scene);
  return {ticks.energy, ticks.heights};
}

}  // namespace carom
