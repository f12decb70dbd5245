// The total is dashed and on top, so that a line beneath it shows.
#include "export/energy_chart.h"

#include "scene/scene.h"

namespace carom {

EnergyChart::EnergyChart(const Scene& scene)
    : scene_(scene), kinetic_(0, end_of(scene)), potential_(0, end_of(scene)), total_(0, end_of(scene)) {}

void EnergyChart::add(double time, double kinetic, double potential) {
  ++instants_;
  kinetic_.add(time, kinetic);
  potential_.add(time, potential);
  total_.add(time, kinetic + potential);
}

Plot EnergyChart::plot() const {
  Plot plot = chart_over_time(scene_, "Energy of all bodies");
  plot.y_label = "energy";
  plot.y_unit = "J";
  plot.series = {chart_line("kinetic", chart_color::vermillion, kinetic_, instants_),
                 chart_line("potential", chart_color::blue, potential_, instants_),
                 chart_line("total", chart_color::black, total_, instants_)};
  plot.series.back().form = PlotForm::dashes;
  return plot;
}

}  // namespace carom
