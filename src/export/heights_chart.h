#pragma once
// The chart of the bodies' heights over time: a line for each of few bodies, the spread of many.

#include "export/chart.h"
#include "physics/state.h"
#include "std.h"

namespace carom {

class HeightsChart {
 public:
  /// With more bodies the chart shows their spread.
  static constexpr size_t most_lines = plot_styles;

  explicit HeightsChart(const Scene& scene);
  /// Whether the chart shows this instant (s), not before the previous one. The spread of many bodies is that of the
  /// first instant in each column.
  bool wants(double time) const;
  /// y of the centres in m, by body. NaN: the body has merged into another.
  void add(double time, span<const double> heights);
  void add(double time, const State& state);
  Plot plot() const;

  void keep(auto& archive) {
    archive(instants_, spreads_);
    for (ThinnedLine& line : lines_) archive(line);
  }

 private:
  /// The heights below which no body, a quarter, half, three quarters and all of them are.
  struct Spread {
    double time, lowest, quarter, median, three_quarters, highest;
  };
  void add_lines(Plot& plot) const;
  void add_spread(Plot& plot) const;

  const Scene& scene_;
  uint64_t instants_ = 0;
  vector<ThinnedLine> lines_;  // by body; empty: too many
  vector<Spread> spreads_;     // by time
  vector<double> heights_;     // reused
};

}  // namespace carom
