// Quantiles are heights of bodies (nearest rank), found by partial sorting.
#include "export/heights_chart.h"

#include <fmt/format.h>

#include "export/bodies.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

HeightsChart::HeightsChart(const Scene& scene) : scene_(scene) {
  const size_t bodies = scene.world.body_count();
  if (bodies <= most_lines) lines_.assign(bodies, ThinnedLine(0, end_of(scene)));
}

bool HeightsChart::wants(double time) const {
  if (!lines_.empty() || spreads_.empty()) return true;
  const auto column = [&](double t) { return interval_of(t, 0, end_of(scene_), ThinnedLine::columns); };
  // The last instant is that of the end.
  return column(time) != column(spreads_.back().time) || time >= end_of(scene_);
}

void HeightsChart::add(double time, const State& state) {
  if (!wants(time)) return;
  vector<double> heights;
  for (Entity body = 0; body < state.position.size(); ++body)
    heights.push_back(is_gone(state, body) ? numeric_limits<double>::quiet_NaN() : state.position[body].y());
  add(time, heights);
}

void HeightsChart::add(double time, span<const double> heights) {
  if (!wants(time)) return;
  ++instants_;
  for (size_t body = 0; body < lines_.size(); ++body)
    if (isfinite(heights[body])) lines_[body].add(time, heights[body]);
  if (!lines_.empty()) return;

  // More bodies than lines: the spread of their heights.
  heights_.clear();
  std::copy_if(heights.begin(), heights.end(), std::back_inserter(heights_), [](double y) { return isfinite(y); });
  if (heights_.empty()) return;

  const auto last = double(heights_.size() - 1);
  const auto quantile = [&](double share) {
    const auto at = heights_.begin() + std::lround(share * last);
    std::nth_element(heights_.begin(), at, heights_.end());
    return *at;
  };
  spreads_.push_back({time, quantile(0), quantile(0.25), quantile(0.5), quantile(0.75), quantile(1)});
}

Plot HeightsChart::plot() const {
  const size_t bodies = scene_.world.body_count();
  Plot plot = chart_over_time(
      scene_, bodies == 1 ? "Height of the body's centre" : fmt::format("Heights of the centres of {} bodies", bodies));
  plot.y_label = "height y";
  plot.y_unit = "m";
  lines_.empty() ? add_spread(plot) : add_lines(plot);
  return plot;
}

void HeightsChart::add_lines(Plot& plot) const {
  for (size_t body = 0; body < lines_.size(); ++body)
    plot.series.push_back(chart_line(scene_.roster.name(Entity(body)), body, lines_[body], instants_));
}

void HeightsChart::add_spread(Plot& plot) const {
  PlotSeries all{"all bodies", chart_color::blue, {}, PlotForm::band, 0.85},
      half{"middle half", chart_color::blue, {}, PlotForm::band, 0.6},
      median{"median", chart_color::blue, {}, PlotForm::line};
  for (const Spread& at : spreads_) {
    all.points.push_back({at.time, at.median, "", at.lowest, at.highest});
    half.points.push_back({at.time, at.median, "", at.quarter, at.three_quarters});
    median.points.push_back({at.time, at.median});
  }
  plot.series = {all, half, median};
}

}  // namespace carom
