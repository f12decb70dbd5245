// Instants are compared exactly: a timeline computes each from its number, so that equal ones are equal to the bit.
#include "export/run_charts.h"

#include <fmt/format.h>

#include "export/gnuplot.h"
#include "physics/energy.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

Ticks ticks_of(const optional<double>& every, double duration) {
  return every ? Ticks::every(*every, duration) : Ticks::even(plot_instants, 0, duration);
}

constexpr RunChart all_charts[] = {
    {"energy", [](const RunCharts& charts) { return charts.energy.plot(); }},
    {"heights", [](const RunCharts& charts) { return charts.heights.plot(); }},
    {"speeds", [](const RunCharts& charts) { return charts.speeds.plot(); }},
    {"collisions", [](const RunCharts& charts) { return charts.collisions.plot(); }},
};

}  // namespace

ChartTicks::ChartTicks(const Scene& scene)
    : energy(ticks_of(plot_intervals(scene.output).energy, end_of(scene))),
      heights(ticks_of(plot_intervals(scene.output).trajectory, end_of(scene))) {}

RunCharts::RunCharts(const Scene& scene)
    : energy(scene),
      heights(scene),
      speeds(scene),
      collisions(scene),
      ticks(scene),
      scene_(scene),
      next_energy_(ticks.energy.first()),
      next_heights_(ticks.heights.first()) {}

void RunCharts::sample(double time, const State& state) {
  if (next_energy_ <= ticks.energy.last() && ticks.energy.at(next_energy_) == time) {
    ++next_energy_;
    energy.add(time, kinetic_energy(scene_.world, state), potential_energy(scene_.world, state));
  }
  if (next_heights_ > ticks.heights.last() || ticks.heights.at(next_heights_) != time) return;
  if (next_heights_++ == ticks.heights.last()) speeds.add(state);
  heights.add(time, state);
}

span<const RunChart> run_charts() {
  return all_charts;
}

vector<ChartFile> draw_charts(span<const string_view> names, const RunCharts& charts, const string& gnuplot) {
  vector<Plot> plots;
  for (const string_view name : names)
    for (const RunChart& chart : all_charts)
      if (chart.name == name) plots.push_back(chart.plot(charts));
  vector<PlotPictures> pictures = draw_plots(plots, gnuplot);
  vector<ChartFile> files;
  for (size_t i = 0; i < pictures.size(); ++i) {
    files.push_back({fmt::format("{}.svg", names[i]), std::move(pictures[i].svg)});
    files.push_back({fmt::format("{}.png", names[i]), std::move(pictures[i].png)});
  }
  return files;
}

}  // namespace carom
