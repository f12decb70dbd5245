// Kinds stand one above the other, so that the upper edge is the rate of all.
#include "export/collisions_chart.h"

#include <fmt/format.h>

#include <numeric>

#include "export/chart.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

const array<CollisionsChart::Row, 4> CollisionsChart::rows = {
    {{CollisionKind::body_body, "body-body", chart_color::blue},
     {CollisionKind::body_fixed, "body-fixed", chart_color::orange},
     {CollisionKind::merge, "merge", chart_color::purple},
     {CollisionKind::taut, "string", chart_color::sky}}};

void CollisionsChart::add(double time, CollisionKind kind) {
  for (size_t k = 0; k < rows.size(); ++k)
    if (rows[k].kind == kind) ++counts_[k][size_t(interval_of(time, 0, end_of(scene_), intervals))];
}

uint64_t CollisionsChart::total() const {
  uint64_t sum = 0;
  for (const Counts& counts : counts_) sum = std::accumulate(counts.begin(), counts.end(), sum);
  return sum;
}

int CollisionsChart::joined() const {
  int join = 1;
  for (const int divisor : {2, 3, 4, 5, 6, 8, 10, 12})
    if (int(intervals) / divisor >= intervals_for(total())) join = divisor;
  return join;
}

Histogram CollisionsChart::histogram(CollisionKind kind) const {
  const auto join = size_t(joined());
  Histogram bars{end_of(scene_) * double(join) / intervals, {}};
  bars.counts.resize(intervals / join);
  for (size_t k = 0; k < rows.size(); ++k)
    if (rows[k].kind == kind)
      for (size_t i = 0; i < intervals; ++i) bars.counts[i / join] += counts_[k][i];
  return bars;
}

Plot CollisionsChart::plot() const {
  const uint64_t all = total();
  Plot plot = chart_over_time(
      scene_, all == 1 ? "Rate of collisions: 1 in all" : fmt::format("Rate of collisions: {} in all", all));
  plot.y_label = "collision rate";
  plot.y_unit = "1/s";
  plot.from_zero = true;
  // A run without duration has no rate.
  if (!(end_of(scene_) > 0)) return plot;

  // Bands above each other, a kind each.
  vector<double> lower(intervals / size_t(joined()), 0);
  for (const Row& row : rows) {
    const Histogram bars = histogram(row.kind);
    if (bars.total() == 0) continue;
    vector<double> upper = lower;
    for (size_t i = 0; i < upper.size(); ++i) upper[i] += double(bars.counts[i]) / bars.width;
    plot.series.push_back({string(row.name), row.style, stairs(bars.width, lower, upper), PlotForm::band, 0.2});
    lower = std::move(upper);
  }
  return plot;
}

}  // namespace carom
