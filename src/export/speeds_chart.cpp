// The temperature follows from the kinetic energy: k T = 2 E / (d N) for N bodies that move in d directions.
#include "export/speeds_chart.h"

#include <fmt/format.h>

#include "export/bodies.h"
#include "export/chart.h"
#include "export/plot_axis.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

constexpr int most_bars = 60;
/// Of the curve.
constexpr int curve_points = 300;
/// The curve ends where it is this share of its peak.
constexpr double end_of_curve = 0.01;

}  // namespace

void SpeedsChart::add(double mass, const Vec3& velocity) {
  speeds_.push_back(velocity.norm());
  ++masses_[mass];
  energy_.add(mass, velocity);
}

void SpeedsChart::add(const State& end) {
  for (Entity body = 0; body < end.velocity.size(); ++body)
    if (!is_gone(end, body)) add(mass_now(scene_.world, end, body), end.velocity[body]);
}

Histogram SpeedsChart::histogram() const {
  Histogram bars;
  const double fastest = speeds_.empty() ? 0 : *ranges::max_element(speeds_);
  // A round width, from 0.7 to 1.8 times the one sought.
  if (fastest > 0) bars.width = round_step(fastest / min(intervals_for(speeds_.size()), most_bars) / sqrt(2)).value();
  bars.counts.resize(size_t(fastest / bars.width) + 1);
  for (const double speed : speeds_) ++bars.counts[min(size_t(speed / bars.width), bars.counts.size() - 1)];
  return bars;
}

bool SpeedsChart::has_maxwell() const {
  return speeds_.size() >= least_bodies && energy_.kinetic() > 0 && !scene_.simulate.contact.merge;
}

double SpeedsChart::maxwell(double speed, double width) const {
  const int dimensions = energy_.dimensions();
  const double thermal = 2 * energy_.kinetic() / (dimensions * double(speeds_.size()));
  double bodies = 0;
  for (const auto& [mass, count] : masses_)
    bodies += double(count) * width * maxwell_density(speed, dimensions, sqrt(thermal / mass));
  return bodies;
}

PlotSeries SpeedsChart::maxwell_curve(const Histogram& bars) const {
  PlotSeries curve{fmt::format("Maxwell, {}-D", energy_.dimensions()), chart_color::black, {}, PlotForm::line};
  double peak = 0;
  const double step = bars.end() / curve_points;
  for (int i = 0; i <= 4 * curve_points; ++i) {
    const double speed = i * step, bodies = maxwell(speed, bars.width);
    if (i > curve_points && bodies < end_of_curve * peak) break;
    peak = max(peak, bodies);
    curve.points.push_back({speed, bodies});
  }
  return curve;
}

Plot SpeedsChart::plot() const {
  Plot plot = chart_of(scene_, fmt::format("{} at {:.6g} s",
                                           speeds_.size() == 1 ? "Speed of the body"
                                                               : fmt::format("Speeds of {} bodies", speeds_.size()),
                                           end_of(scene_)));

  const Histogram bars = histogram();
  plot.x_label = "speed";
  plot.x_unit = "m/s";
  plot.y_label = fmt::format("bodies in {:.6g} m/s", bars.width);
  plot.x_from = 0;
  plot.from_zero = plot.counts = true;

  const vector<double> counts(bars.counts.begin(), bars.counts.end());
  plot.series.push_back(
      {"bodies", chart_color::sky, stairs(bars.width, vector<double>(counts.size(), 0), counts), PlotForm::band, 0.2});

  if (!has_maxwell()) return plot;
  plot.series.push_back(maxwell_curve(bars));
  plot.subtitle += "; the curve has the same kinetic energy";
  return plot;
}

}  // namespace carom
