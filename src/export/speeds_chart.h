#pragma once
// The chart of the bodies' speeds at the end of a run, beside Maxwell's distribution.

#include "export/histogram.h"
#include "physics/maxwell.h"
#include "physics/state.h"
#include "std.h"

namespace carom {

struct Scene;

class SpeedsChart {
 public:
  /// Fewer bodies have no distribution to compare.
  static constexpr size_t least_bodies = 30;

  explicit SpeedsChart(const Scene& scene) : scene_(scene) {}
  /// A body at the end of the run; kg, m/s.
  void add(double mass, const Vec3& velocity);
  void add(const State& end);

  Histogram histogram() const;
  /// Maxwell's distribution with the kinetic energy and the directions of all bodies: how many of them an interval of
  /// this width (m/s) at a speed (m/s) holds. Bodies of several masses have one temperature, and the curve is the sum
  /// of theirs.
  double maxwell(double speed, double width) const;
  /// Whether that is drawn: bodies move, there are at least least_bodies, and they do not merge.
  bool has_maxwell() const;
  Plot plot() const;

  void keep(auto& archive) { archive(speeds_, masses_, energy_); }

 private:
  PlotSeries maxwell_curve(const Histogram& bars) const;

  const Scene& scene_;
  vector<double> speeds_;       // m/s
  map<double, size_t> masses_;  // kg, and the number of bodies
  EnergyByDirection energy_;
};

}  // namespace carom
